// The C++ header, and one atlas and one file of cells read by several threads at once: cpp ATLAS CELLS.

#include <spiral_atlas.hpp>

#include "check.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <thread>

namespace sa = spiral_atlas;

template <typename Call> static void throws(SpiralStatus status, const std::string &word, Call call) {
    try {
        call();
    } catch (const sa::Error &error) {
        CHECK(error.status() == status && std::string(error.what()).find(word) != std::string::npos);
        return;
    }
    std::fprintf(stderr, "no exception, but it should say %s\n", word.c_str());
    std::exit(1);
}

/// Points that fill a box evenly, the same on every machine.
static std::vector<double> points(std::size_t count) {
    const double low[4] = {0.1, 0.2, 0.02, 1}, high[4] = {1.2, 1.4, 0.9, 90};
    const double steps[4] = {0.8566748838545029, 0.733891856627126, 0.6287067210378087, 0.5385972572236101};
    std::vector<double> all;
    for (std::size_t i = 0; i < count; i++)
        for (std::size_t j = 0; j < 4; j++) {
            const double turns = static_cast<double>(i) * steps[j];
            all.push_back(low[j] + (high[j] - low[j]) * (turns - std::floor(turns)));
        }
    return all;
}

int main(int, char **arguments) {
    throws(SPIRAL_IO, "nowhere", [] { sa::Atlas("nowhere"); });
    throws(SPIRAL_FILE, "cells", [&] { sa::Atlas{arguments[2]}; });
    const sa::Atlas atlas(arguments[1]);
    const sa::Cells cells(arguments[2]);
    atlas.check();
    CHECK(atlas.family() == "cubic" && atlas.axes() == 4 && atlas.axis_name(0) == "phi0" && atlas.axis(0).size() > 1);
    CHECK(atlas.flags().size() == atlas.solutions().size() && atlas.flag("SPIRAL") == sa::flag("cubic", "SPIRAL"));
    throws(SPIRAL_ARGUMENT, "3 numbers", [&] { atlas.lookup(std::vector<double>(3)); });

    const std::vector<double> data = points(2000);
    const auto truth = sa::solve_batch("cubic", data);
    const auto found = atlas.lookup(data);
    const auto known = cells.lookup(data);
    const auto holds = cells.verdict(data);
    for (std::size_t i = 0; i < 2000; i++) {
        CHECK(found.nodes[i] < 0 || found.flags[i] == atlas.flags()[static_cast<std::size_t>(found.nodes[i])]);
        CHECK(holds[i] == truth.flags[i] && (known.inside[i] & ~holds[i]) == 0 && (known.outside[i] & holds[i]) == 0);
    }

    // Curves of many data are those of single answers.
    const auto curves = sa::solve_batch_curves("cubic", data);
    CHECK(curves.flags == truth.flags && curves.each == 4 && curves.control_points.size() == 8000);
    for (std::size_t i = 0; i < 2000; i += 100) {
        const sa::Answer single("cubic", sa::View<const double>(data.data() + 4 * i, 4));
        if (!single.chosen()) {
            CHECK(std::isnan(curves.control_points[4 * i][0]));
            continue;
        }
        const auto own = single.points(*single.chosen(), "control_points");
        CHECK(std::equal(own.begin(), own.end(), curves.control_points.begin() + 4 * static_cast<long>(i)));
    }
    throws(SPIRAL_DOMAIN, "no control points", [&] { sa::solve_batch_curves("any-spiral", data); });
    CHECK(sa::solve_batch_curves("cubic", std::vector<double>()).control_points.empty());

    // Each thread has an error of its own, and all read the same handles.
    std::vector<std::thread> threads;
    for (int t = 0; t < 4; t++)
        threads.emplace_back([&, t] {
            const std::string name = "none" + std::to_string(t);
            for (int round = 0; round < 50; round++) {
                CHECK(atlas.lookup(data).flags == found.flags && cells.lookup(data).inside == known.inside);
                throws(SPIRAL_DOMAIN, "`" + name + "`", [&] { atlas.flag(name); });
            }
            CHECK(cells.verdict(data) == holds && sa::solve_batch("cubic", data, 2).flags == truth.flags);
        });
    for (auto &thread : threads) thread.join();

    const double datum[] = {0.7, 1.4, 0.4, 4};
    const sa::Answer answer("cubic", datum);
    CHECK(answer.chosen() && std::abs(answer.number(*answer.chosen(), "f0") - 1.6601027476816781) < 1e-12);
    CHECK(answer.points(0, "control_points").size() == 4);
    throws(SPIRAL_NONE, "`f9`", [&] { answer.number(0, "f9"); });

    std::string reason;
    const auto curve = sa::fit({0, 0, -0.7, 0.004}, {200, 0, 1.4, 0.04});
    CHECK(curve && curve->kind() == "cubic" && curve->control_points().size() == 4 && curve->stations(11)[10].x == 200);
    CHECK(!sa::fit({0, 0, 0.7, 0.004}, {200, 0, 1.4, 0.04}, "involute", 1e300, &reason) && !reason.empty());
    const auto ramp = sa::join({0, 0, 0, 0}, {180, 150, 1.7, 0}, 0.0166);
    CHECK(ramp && ramp->kind() == "path" && std::abs(ramp->stations(3)[2].y - 150) < 1e-9);
    const auto gentle = sa::join({0, 0, 0, 0}, {180, 150, 1.7, 0}, 0.0166, "cubic", "greatest-rate", 400);
    CHECK(gentle && gentle->length() > ramp->length() && gentle->length() <= 400);
    CHECK(!sa::join({0, 0, 0, 0}, {180, 150, 1.7, 0}, 0.0166, "cubic", "length", 1e4, 1, &reason));
    CHECK(reason.find("1 piece") != std::string::npos);
    throws(SPIRAL_DOMAIN, "`beauty`", [] { sa::join({0, 0, 0, 0}, {1, 0, 0, 0}, 1, "cubic", "beauty"); });
    CHECK(sa::path("spline", "{\"points\": [[0, 0], [1, 1]]}").find("\"kind\":\"ph-quintic\"") != std::string::npos);
    throws(SPIRAL_DOMAIN, "points[1]", [] { sa::path("spline", "{\"points\": [[0, 0], 7]}"); });
    throws(SPIRAL_DOMAIN, "NaN", [] { sa::fit({std::nan(""), 0, 0, 0}, {1, 0, 0, 0}); });

    const auto spirals = sa::ranges("cubic", datum, 3, {0, 100});
    CHECK(spirals.ranges.size() == 1 && spirals.open.empty() && spirals.ranges[0].ends[0] < 4 &&
          4 < spirals.ranges[0].ends[1]);
    throws(SPIRAL_ARGUMENT, "3 numbers", [] { sa::ranges("cubic", std::vector<double>(3), 3, {0, 100}); });
    const double inf = std::numeric_limits<double>::infinity(), weights[] = {inf, inf, 1, 1};
    const double outside[] = {0.7, 1.4, 1, 2};
    const auto nearest = sa::nearest("cubic", outside, weights);
    CHECK(nearest.point && (*nearest.point)[0] == 0.7 && nearest.at_least <= nearest.distance && nearest.at_least > 0);
    CHECK(sa::nearest("cubic", datum).distance == 0);
    const auto none = sa::nearest("cubic", outside, std::vector<double>(4, inf));
    CHECK(!none.point && none.at_least == inf);
    throws(SPIRAL_ARGUMENT, "weight", [&] { sa::nearest("cubic", outside, std::vector<double>(2, 1.0)); });
    const auto outline = sa::boundary("cubic", datum, {2, 3}, {{{0, 0.8}, {0, 20}}}, 64);
    CHECK(!outline.lines.empty() && outline.lines[0].points.size() > 10 && outline.cell[1] == 0.3125);
    throws(SPIRAL_DOMAIN, "`NONE`", [&] { sa::boundary("cubic", datum, {2, 3}, {{{0, 0.8}, {0, 20}}}, 64, "NONE"); });
    std::puts("C++: all as it should be");
}
