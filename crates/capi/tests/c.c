/* The C interface, from C: c ATLAS CELLS. Every call that can fail is seen to fail as well. */

#include <math.h>
#include <spiral_atlas.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define CHECK(condition)                                                                            \
    do {                                                                                            \
        if (!(condition)) {                                                                         \
            fprintf(stderr, "%s:%d: not so: %s; last error: %s\n", __FILE__, __LINE__, #condition, \
                    spiral_last_error()); \
            exit(1);                                                                                \
        }                                                                                           \
    } while (0)

static int says(const char *word) { return strstr(spiral_last_error(), word) != NULL; }

static void atlases(const char *path) {
    SpiralAtlas *atlas = NULL;
    CHECK(spiral_atlas_open("/nowhere/none.safetensors", &atlas) == SPIRAL_IO && says("/nowhere/none") &&
          atlas == NULL);
    CHECK(spiral_atlas_open(NULL, &atlas) == SPIRAL_ARGUMENT && says("`path`"));
    CHECK(spiral_atlas_open(path, NULL) == SPIRAL_ARGUMENT && says("`atlas`"));
    CHECK(spiral_atlas_open(path, &atlas) == SPIRAL_OK);
    CHECK(strcmp(spiral_atlas_family(atlas), "cubic") == 0 && spiral_atlas_axes(atlas) == 4);
    const char *name = NULL;
    const double *values = NULL;
    size_t count = 0;
    size_t nodes_in_all = 1;
    double point[8] = {0};
    for (size_t i = 0; i < 4; i++) {
        CHECK(spiral_atlas_axis(atlas, i, &name, &values, &count) == SPIRAL_OK && count > 1);
        point[i] = values[1];
        nodes_in_all *= count;
    }
    CHECK(strcmp(name, "kappa1") == 0);
    CHECK(spiral_atlas_axis(atlas, 4, &name, &values, &count) == SPIRAL_DOMAIN && says("axis 4"));
    const uint8_t *all = NULL;
    CHECK(spiral_atlas_data(atlas, &all, NULL, &count) == SPIRAL_OK && count == nodes_in_all);
    uint8_t mask = 0;
    CHECK(spiral_atlas_flag(atlas, "SPIRAL", &mask) == SPIRAL_OK && mask != 0);
    CHECK(spiral_atlas_flag(atlas, "SPIRALS", &mask) == SPIRAL_DOMAIN && says("`SPIRALS`"));
    CHECK(spiral_atlas_flag(atlas, "\xff", &mask) == SPIRAL_ARGUMENT && says("UTF-8"));
    int64_t nodes[2];
    uint8_t flags[2], solutions[2];
    point[4] = 99;
    CHECK(spiral_atlas_lookup(atlas, point, 2, nodes, flags, solutions) == SPIRAL_OK);
    CHECK(nodes[0] > 0 && flags[0] == all[nodes[0]] && nodes[1] == -1 && flags[1] == 0 && solutions[1] == 0);
    CHECK(spiral_atlas_lookup(atlas, point, 2, NULL, NULL, NULL) == SPIRAL_OK);
    CHECK(spiral_atlas_lookup(atlas, NULL, 0, nodes, flags, solutions) == SPIRAL_OK);
    CHECK(spiral_atlas_lookup(atlas, NULL, 1, nodes, flags, solutions) == SPIRAL_ARGUMENT && says("`points`"));
    CHECK(spiral_atlas_lookup(atlas, point, SIZE_MAX, nodes, flags, solutions) == SPIRAL_ARGUMENT && says("memory"));
    CHECK(spiral_atlas_lookup(NULL, point, 1, nodes, flags, solutions) == SPIRAL_ARGUMENT);
    CHECK(spiral_atlas_check(atlas) == SPIRAL_OK);

    /* The nodes are what the family says of them. */
    uint8_t own_flags, own_solutions;
    CHECK(spiral_solve_batch("cubic", NULL, point, 1, 0, &own_flags, &own_solutions, NULL) == SPIRAL_OK);
    CHECK(own_flags == flags[0] && own_solutions == solutions[0]);
    spiral_atlas_close(atlas);
    spiral_atlas_close(NULL);
}

static void cells(const char *path) {
    SpiralCells *cells = NULL;
    SpiralAtlas *atlas = NULL;
    CHECK(spiral_atlas_open(path, &atlas) == SPIRAL_FILE && says("cells"));
    CHECK(spiral_cells_open(path, &cells) == SPIRAL_OK && spiral_cells_axes(cells) == 4);
    uint8_t spiral = 0, inside[2], outside[2], holds[2], truth[2];
    CHECK(spiral_cells_flag(cells, "SPIRAL", &spiral) == SPIRAL_OK);
    double points[8] = {0.7, 1.3, 0.4, 4, 0.7, 1.3, 0.4, 400};
    CHECK(spiral_cells_lookup(cells, points, 2, inside, outside) == SPIRAL_OK && inside[1] == 0 && outside[1] == 0);
    CHECK(spiral_cells_verdict(cells, points, 2, 255, holds) == SPIRAL_OK);
    CHECK(spiral_solve_batch("cubic", NULL, points, 2, 1, truth, NULL, NULL) == SPIRAL_OK);
    CHECK(holds[0] == truth[0] && holds[1] == truth[1] && (inside[0] & ~truth[0]) == 0 && (outside[0] & truth[0]) == 0);
    points[4] = NAN;
    CHECK(spiral_cells_verdict(cells, points, 2, spiral, holds) == SPIRAL_DOMAIN && says("row 1") && says("phi0"));
    spiral_cells_close(cells);
    spiral_cells_close(NULL);
}

static void answers(void) {
    SpiralAnswer *answer = NULL;
    const double datum[4] = {0.7, 1.4, 0.4, 4};
    CHECK(spiral_solve("cubics", NULL, datum, &answer) == SPIRAL_DOMAIN && says("`cubics`") && answer == NULL);
    CHECK(spiral_solve("cubic", "flat", datum, &answer) == SPIRAL_DOMAIN && says("`flat`"));
    CHECK(spiral_solve("cubic", NULL, datum, &answer) == SPIRAL_OK);
    uint8_t flags = 0, mask = 0;
    size_t count = 0;
    int64_t chosen = -1;
    CHECK(spiral_answer_verdict(answer, &flags, NULL, &count, &chosen) == SPIRAL_OK && count == 1 && chosen == 0);
    CHECK(spiral_family_flag("cubic", "SPIRAL", &mask) == SPIRAL_OK && (flags & mask) != 0);
    double f0 = 0;
    CHECK(spiral_answer_number(answer, chosen, "f0", &f0) == SPIRAL_OK && fabs(f0 - 1.6601027476816781) < 1e-12);
    CHECK(spiral_answer_number(answer, chosen, "f9", &f0) == SPIRAL_NONE && says("`f9`") && says("margin"));
    CHECK(spiral_answer_number(answer, 7, "f0", &f0) == SPIRAL_DOMAIN && says("solution 7"));
    double points[4][2];
    CHECK(spiral_answer_points(answer, chosen, "control_points", points, 4, &count) == SPIRAL_OK && count == 4);
    CHECK(points[0][0] == -1 && points[0][1] == 0 && points[3][0] == 1 && points[3][1] == 0);
    spiral_answer_close(answer);
    const double bad[4] = {0.7, 4.0, 0.4, 4};
    CHECK(spiral_solve("cubic", NULL, bad, &answer) == SPIRAL_DOMAIN && says("phi"));
}

static void curves(void) {
    const char *kinds[] = {"cubic", "ph-quintic", "involute"};
    const SpiralEnd start = {0, 0, -0.7, 0.004}, end = {200, 0, 1.4, 0.04}, wrong = {0, 0, 0.7, 0.004};
    SpiralCurve *curve = NULL;
    for (size_t i = 0; i < 3; i++) {
        CHECK(spiral_fit(&start, &end, kinds[i], INFINITY, &curve) == SPIRAL_OK);
        CHECK(strcmp(spiral_curve_kind(curve), kinds[i]) == 0 && strstr(spiral_curve_json(curve), kinds[i]) != NULL);
        SpiralStation stations[101];
        CHECK(spiral_curve_stations(curve, stations, 101) == SPIRAL_OK);
        CHECK(fabs(stations[100].station - spiral_curve_length(curve)) < 1e-9 && stations[100].x == 200);
        CHECK(fabs(stations[0].curvature - 0.004) < 1e-9 && fabs(stations[100].heading - 1.4) < 1e-9);
        for (size_t k = 1; k < 101; k++) CHECK(stations[k].curvature > stations[k - 1].curvature - 1e-12);
        CHECK(spiral_curve_stations(curve, stations, 1) == SPIRAL_DOMAIN &&
              spiral_curve_stations(curve, NULL, 5) == SPIRAL_ARGUMENT);
        double points[6][2];
        size_t count = 99;
        CHECK(spiral_curve_control_points(curve, points, 6, &count) == SPIRAL_OK);
        CHECK(count == (i == 0 ? 4u : i == 1 ? 6u : 0u));
        spiral_curve_close(curve);
        curve = NULL;
        CHECK(spiral_fit(&wrong, &end, kinds[i], INFINITY, &curve) == SPIRAL_NONE && strlen(spiral_last_error()) > 20);
        CHECK(spiral_fit(&start, &end, kinds[i], 200.0, &curve) == SPIRAL_NONE && curve == NULL);
    }
    CHECK(spiral_fit(&start, &end, NULL, INFINITY, &curve) == SPIRAL_OK);
    spiral_curve_close(curve);
    CHECK(spiral_fit(&start, &start, NULL, INFINITY, &curve) == SPIRAL_DOMAIN);
    CHECK(spiral_fit(&start, &end, "clothoid", INFINITY, &curve) == SPIRAL_DOMAIN && says("clothoid"));
    const SpiralEnd nan = {NAN, 0, -0.7, 0.004};
    CHECK(spiral_fit(&nan, &end, NULL, INFINITY, &curve) == SPIRAL_DOMAIN && says("NaN"));
}

static void joins(void) {
    const SpiralEnd start = {0, 0, 0, 0}, end = {180, 150, 1.7, 0};
    const char *kinds[] = {"cubic", "ph-quintic", "involute", NULL};
    SpiralCurve *curve = NULL;
    for (size_t i = 0; i < 4; i++) {
        CHECK(spiral_join(&start, &end, 0.0166, kinds[i], NULL, 1e4, SIZE_MAX, &curve) == SPIRAL_OK);
        CHECK(strcmp(spiral_curve_kind(curve), "path") == 0 &&
              strstr(spiral_curve_json(curve), "{\"pieces\":[") == spiral_curve_json(curve));
        SpiralStation stations[501];
        size_t count = 9;
        CHECK(spiral_curve_stations(curve, stations, 501) == SPIRAL_OK);
        CHECK(spiral_curve_control_points(curve, NULL, 0, &count) == SPIRAL_OK && count == 0);
        for (size_t k = 0; k < 501; k++) CHECK(fabs(stations[k].curvature) < 0.0166 * (1 + 1e-9));
        CHECK(fabs(stations[500].x - 180) < 1e-9 && fabs(stations[500].heading - 1.7) < 1e-9);
        CHECK(fabs(stations[500].station - spiral_curve_length(curve)) < 1e-9);
        spiral_curve_close(curve);
        curve = NULL;
    }
    /* A gentle join is longer than the shortest, and turns the wheel more slowly. */
    double lengths[2], rates[2] = {0};
    for (size_t i = 0; i < 2; i++) {
        const char *objective = i == 0 ? "length" : "greatest-rate";
        SpiralStation stations[501];
        CHECK(spiral_join(&start, &end, 0.0166, NULL, objective, 400, 11, &curve) == SPIRAL_OK);
        CHECK(spiral_curve_stations(curve, stations, 501) == SPIRAL_OK);
        lengths[i] = spiral_curve_length(curve);
        for (size_t k = 1; k < 501; k++)
            rates[i] = fmax(rates[i], fabs(stations[k].curvature - stations[k - 1].curvature) / lengths[i] * 500);
        spiral_curve_close(curve);
        curve = NULL;
    }
    CHECK(lengths[0] < lengths[1] && lengths[1] <= 400 && rates[1] < 0.9 * rates[0]);
    CHECK(spiral_join(&start, &end, 0.0166, NULL, NULL, INFINITY, 1, &curve) == SPIRAL_NONE && says("1 piece") &&
          curve == NULL);
    CHECK(spiral_join(&start, &end, 0.0166, NULL, NULL, INFINITY, 0, &curve) == SPIRAL_DOMAIN && says("pieces are 0"));
    CHECK(spiral_join(&start, &end, 0.0166, NULL, NULL, 100, SIZE_MAX, &curve) == SPIRAL_NONE && says("100"));
    CHECK(spiral_join(&start, &end, 0, NULL, NULL, INFINITY, 9, &curve) == SPIRAL_DOMAIN && says("greatest curvature"));
    CHECK(spiral_join(&start, &end, 0.0166, "arc", NULL, INFINITY, 9, &curve) == SPIRAL_DOMAIN &&
          says("the kind is `arc`; it must be cubic, ph-quintic, involute, trig-quintic or clothoid"));
    CHECK(spiral_join(&start, &end, 0.0166, NULL, "beauty", INFINITY, 9, &curve) == SPIRAL_DOMAIN &&
          says("`beauty`; it must be length, greatest-curvature, greatest-rate or bending-energy"));
    CHECK(spiral_join(&start, &end, 0.0166, NULL, "\xff", INFINITY, 9, &curve) == SPIRAL_ARGUMENT &&
          says("`objective` is no UTF-8"));
}

static void questions(void) {
    const double datum[4] = {0.7, 1.4, 0.4, 0}, outside[4] = {0.7, 1.4, 1, 2};
    SpiralRanges *ranges = NULL;
    CHECK(spiral_ranges("cubic", NULL, NULL, datum, 3, 0, 100, &ranges) == SPIRAL_OK);
    const SpiralRange *all = NULL;
    const double(*open)[2] = NULL;
    size_t count = 0, open_count = 9;
    CHECK(spiral_ranges_data(ranges, &all, &count, &open, &open_count) == SPIRAL_OK && count == 1 && open_count == 0);
    /* The ends have the property, and their neighbours do not. */
    uint8_t mask = 0, flags[4];
    CHECK(spiral_family_flag("cubic", "SPIRAL", &mask) == SPIRAL_OK);
    const double low = all[0].ends[0], high = all[0].ends[1];
    const double edges[4] = {nextafter(low, 0), low, high, nextafter(high, 1000)};
    double rows[16];
    for (size_t i = 0; i < 4; i++) {
        memcpy(rows + 4 * i, datum, sizeof datum);
        rows[4 * i + 3] = edges[i];
    }
    CHECK(spiral_solve_batch("cubic", NULL, rows, 4, 1, flags, NULL, NULL) == SPIRAL_OK);
    for (size_t i = 0; i < 4; i++) CHECK(((flags[i] & mask) != 0) == (i == 1 || i == 2));
    CHECK(!all[0].cut[0] && !all[0].cut[1]);
    CHECK(all[0].outer[0] <= all[0].inner[0] && all[0].inner[0] < all[0].inner[1] &&
          all[0].inner[1] <= all[0].outer[1]);
    CHECK(spiral_ranges_data(ranges, NULL, NULL, NULL, NULL) == SPIRAL_OK);
    CHECK(spiral_ranges_data(NULL, &all, NULL, NULL, NULL) == SPIRAL_ARGUMENT && says("`ranges`"));
    spiral_ranges_close(ranges);
    spiral_ranges_close(NULL);
    ranges = NULL;
    CHECK(spiral_ranges("cubic", NULL, NULL, datum, 4, 0, 100, &ranges) == SPIRAL_DOMAIN && says("number 4"));
    CHECK(spiral_ranges("cubic", NULL, NULL, datum, 3, 0, NAN, &ranges) == SPIRAL_DOMAIN && says("NaN"));
    CHECK(spiral_ranges("cubic", NULL, "SPIRALS", datum, 3, 0, 100, &ranges) == SPIRAL_DOMAIN && says("`SPIRALS`"));
    /* A family of five coordinates. */
    const double shape[5] = {1, 0.7, 1, 0, 0};
    CHECK(spiral_ranges("trig-quintic", NULL, "SPIRAL", shape, 0, 1, 10, &ranges) == SPIRAL_OK);
    CHECK(spiral_ranges_data(ranges, &all, &count, NULL, NULL) == SPIRAL_OK && count == 1 && all[0].ends[1] == 10);
    spiral_ranges_close(ranges);
    ranges = NULL;
    CHECK(spiral_ranges("cubic", NULL, NULL, NULL, 3, 0, 100, &ranges) == SPIRAL_ARGUMENT && says("`datum`"));
    CHECK(spiral_ranges("cubic", NULL, NULL, datum, 3, 0, 100, NULL) == SPIRAL_ARGUMENT && ranges == NULL);

    const double weights[4] = {INFINITY, INFINITY, 1, 1}, fixed[4] = {INFINITY, INFINITY, INFINITY, INFINITY};
    double nearest[4] = {0}, distance = 0, at_least = 0;
    CHECK(spiral_nearest("cubic", NULL, NULL, outside, weights, nearest, &distance, &at_least) == SPIRAL_OK);
    CHECK(nearest[0] == 0.7 && nearest[1] == 1.4 && at_least > 0 && at_least <= distance && distance < 1.01 * at_least);
    CHECK(fabs(hypot(nearest[2] - 1, nearest[3] - 2) - distance) < 1e-12);
    CHECK(spiral_solve_batch("cubic", NULL, nearest, 1, 1, flags, NULL, NULL) == SPIRAL_OK && (flags[0] & mask) != 0);
    CHECK(spiral_nearest("cubic", NULL, NULL, outside, NULL, NULL, &distance, NULL) == SPIRAL_OK && distance > 0);
    at_least = 0;
    CHECK(spiral_nearest("cubic", NULL, NULL, outside, fixed, nearest, &distance, &at_least) == SPIRAL_NONE &&
          says("SPIRAL"));
    CHECK(isinf(at_least));
    CHECK(spiral_nearest("cubic", NULL, NULL, outside, datum, nearest, &distance, NULL) == SPIRAL_DOMAIN &&
          says("weight"));

    const size_t axes[2] = {2, 3}, twice[2] = {2, 2};
    const double within[2][2] = {{0, 0.8}, {0, 20}};
    SpiralBoundary *boundary = NULL;
    CHECK(spiral_boundary("cubic", NULL, NULL, datum, axes, within, 64, &boundary) == SPIRAL_OK);
    CHECK(spiral_boundary_lines(boundary) > 0 && spiral_boundary_lines(NULL) == 0);
    const double(*xy)[2] = NULL;
    uint8_t closed = 9;
    CHECK(spiral_boundary_line(boundary, 0, &xy, &count, &closed) == SPIRAL_OK && count > 10 && closed <= 1);
    for (size_t i = 0; i < count; i++) CHECK(xy[i][0] >= 0 && xy[i][0] <= 0.8 && xy[i][1] >= 0 && xy[i][1] <= 20);
    CHECK(spiral_boundary_line(boundary, 99, &xy, &count, &closed) == SPIRAL_DOMAIN && says("line 99"));
    double cell[2] = {0};
    const double(*cells_open)[2][2] = NULL;
    CHECK(spiral_boundary_open(boundary, &cells_open, &count, cell) == SPIRAL_OK && cell[0] == 0.0125 &&
          cell[1] == 0.3125);
    spiral_boundary_close(boundary);
    spiral_boundary_close(NULL);
    boundary = NULL;
    CHECK(spiral_boundary("cubic", NULL, NULL, datum, twice, within, 64, &boundary) == SPIRAL_DOMAIN);
    CHECK(spiral_boundary("cubic", NULL, NULL, datum, axes, within, 63, &boundary) == SPIRAL_DOMAIN && says("63"));
    CHECK(spiral_boundary("cubic", NULL, NULL, datum, NULL, within, 64, &boundary) == SPIRAL_ARGUMENT &&
          boundary == NULL);
}

static void paths(void) {
    SpiralReport *report = NULL;
    const char *wave = "{\"points\": [[0, 0], [1, 1], [2, 0], [3, 1]]}";
    CHECK(spiral_path("spline", wave, &report) == SPIRAL_OK);
    CHECK(strncmp(spiral_report_json(report), "{\"paths\":[{\"length\":", 20) == 0);
    spiral_report_close(report);
    spiral_report_close(NULL);
    CHECK(spiral_report_json(NULL) == NULL);
    CHECK(spiral_path("splines", wave, &report) == SPIRAL_DOMAIN && says("`splines`") && says("`hermite`"));
    CHECK(spiral_path("spline", "{\"points\": [[0, 0], [1]]}", &report) == SPIRAL_DOMAIN && says("points[1]"));
    CHECK(spiral_path("spline", "\xff", &report) == SPIRAL_ARGUMENT && says("UTF-8"));
    CHECK(spiral_path(NULL, wave, &report) == SPIRAL_ARGUMENT && says("`tool`"));
    CHECK(spiral_path("spline", wave, NULL) == SPIRAL_ARGUMENT && says("`report`"));
}

int main(int count, char **arguments) {
    CHECK(count == 3 && strlen(spiral_version()) > 4 && strlen(spiral_last_error()) == 0);
    atlases(arguments[1]);
    cells(arguments[2]);
    answers();
    curves();
    joins();
    questions();
    paths();
    puts("C: all as it should be");
    return 0;
}
