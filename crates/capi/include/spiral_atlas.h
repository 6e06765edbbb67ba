/* Proved answers about transition curves of monotone curvature: https://crates.io/crates/spiral-atlas, docs/cpp.md.
 *
 * Every function that can fail returns a SpiralStatus; spiral_last_error() says in words what was wrong. Handles are
 * opaque. One handle may be read by several threads at once; closing it is the caller's to order. No function keeps a
 * pointer that it is given, and none lets a panic or an exception through.
 *
 * Made by cbindgen from crates/capi/src; a test compares the two. */

#ifndef SPIRAL_ATLAS_H
#define SPIRAL_ATLAS_H

#include <stddef.h>
#include <stdint.h>

// How a call went.
typedef enum {
    // It succeeded.
    SPIRAL_OK = 0,
    // There is no such curve or value: an answer, not a mistake. The last error is the reason.
    SPIRAL_NONE = 1,
    // An argument is a null pointer, no UTF-8, or the like.
    SPIRAL_ARGUMENT = 2,
    // A number lies outside its domain, or a name is unknown.
    SPIRAL_DOMAIN = 3,
    // The system refuses to read.
    SPIRAL_IO = 4,
    // A file is not a valid atlas.
    SPIRAL_FILE = 5,
    // A verdict is not proved at the precision cap.
    SPIRAL_UNDECIDED = 6,
    // A fault in the library itself. Please report it.
    SPIRAL_INTERNAL = 7,
} SpiralStatus;

// All that a family knows of a datum.
typedef struct SpiralAnswer SpiralAnswer;

// An atlas file, mapped into memory.
typedef struct SpiralAtlas SpiralAtlas;

// The outline of a property in a slice.
typedef struct SpiralBoundary SpiralBoundary;

// A file of certified cells, mapped into memory.
typedef struct SpiralCells SpiralCells;

// A curve of one or more pieces.
typedef struct SpiralCurve SpiralCurve;

// All that is known of a property along one coordinate.
typedef struct SpiralRanges SpiralRanges;

// What a path tool answered.
typedef struct SpiralReport SpiralReport;

// One end of a curve, in the user's unit of length.
typedef struct {
    // Place along the x axis.
    double x;
    // Place along the y axis.
    double y;
    // Direction of travel: angle from the x axis, radians, counter-clockwise.
    double direction;
    // Signed curvature, 1 / length, positive where the curve turns left.
    double curvature;
} SpiralEnd;

// A point of a curve.
typedef struct {
    // Arc length from the start.
    double station;
    // Place along the x axis.
    double x;
    // Place along the y axis.
    double y;
    // Direction of travel, radians, in [-pi, pi].
    double heading;
    // Signed curvature.
    double curvature;
} SpiralStation;

// An interval of a coordinate in which a property holds.
typedef struct {
    // The property holds at these numbers. At their neighbours outside it does not, unless the range is cut there.
    double ends[2];
    // It holds at each number from the first to the second: proved.
    double inner[2];
    // Below the first and above the second it fails up to the next range or open interval, or to the end of the
    // interval that was asked about: proved.
    double outer[2];
    // 1 for an end that is none of the property: the interval that was asked about ends there, and the property goes
    // on beyond. Otherwise 0.
    uint8_t cut[2];
} SpiralRange;

#ifdef __cplusplus
extern "C" {
#endif // __cplusplus

// The number of coordinates of a datum. `chart` may be null: the family's first.
//
// # Safety
// `family` and `chart` are null or texts that end with a zero byte; `count` is null or valid for a write.
SpiralStatus spiral_family_axes(const char *family, const char *chart, size_t *count);

// The number of control points of a family's curves; 0 where its curves have none.
//
// # Safety
// `family` is null or a text that ends with a zero byte; `count` is null or valid for a write.
SpiralStatus spiral_family_control_points(const char *family, size_t *count);

// The mask of a family's flag, by name.
//
// # Safety
// `family` and `name` are null or texts that end with a zero byte; `mask` is null or valid for a write.
SpiralStatus spiral_family_flag(const char *family, const char *name, uint8_t *mask);

// The proved verdicts of `count` data: flags and packed counts, as an atlas has them at its nodes.
//
// `threads` are the workers; 0 stands for as many as the machine has cores. A datum outside the family's domain is
// SPIRAL_DOMAIN and one that is not decided SPIRAL_UNDECIDED; the last error names the first such row, and no result
// is written.
//
// `control_points` receives the curves: for each datum as many points as spiral_family_control_points says, those of
// the chosen curve in the family's frame, or NaN where there is none.
//
// # Safety
// `family` and `chart` are null or texts that end with a zero byte (a null `chart` is the family's first); `data`
// holds `count` rows of as many numbers as the chart has axes; `flags` and `solutions` are null, when they are not
// wanted, or have room for `count` values; `control_points` is null, when no curves are wanted, or has room for
// `count` times the family's number of points.
SpiralStatus spiral_solve_batch(const char *family,
                                const char *chart,
                                const double *data,
                                size_t count,
                                size_t threads,
                                uint8_t *flags,
                                uint8_t *solutions,
                                double (*control_points)[2]);

// The exact answer for one datum, with its curves. Close it with spiral_answer_close.
//
// # Safety
// `family` and `chart` are null or texts that end with a zero byte (a null `chart` is the family's first); `datum`
// holds as many numbers as the chart has axes; `answer` is null or valid for a write.
SpiralStatus spiral_solve(const char *family,
                          const char *chart,
                          const double *datum,
                          SpiralAnswer **answer);

// Closes an answer. Null is allowed.
//
// # Safety
// `answer` comes from spiral_solve and is not used any more.
void spiral_answer_close(SpiralAnswer *answer);

// Flags, packed counts, number of solutions, and index of the chosen one (-1 where there is none).
//
// # Safety
// `answer` is null or open; each of the others is null, when it is not wanted, or valid for a write.
SpiralStatus spiral_answer_verdict(const SpiralAnswer *answer,
                                   uint8_t *flags,
                                   uint8_t *counts,
                                   size_t *solutions,
                                   int64_t *chosen);

// A number of a solution by its name, as JSON has it (`query --json`): "f0", "margin", "length", ...; a condition is 0
// or 1. The index -1 stands for what follows from the datum itself. SPIRAL_NONE where there is no such number.
//
// # Safety
// `answer` is null or open; `name` is null or a text that ends with a zero byte; `number` is null or valid for a
// write.
SpiralStatus spiral_answer_number(const SpiralAnswer *answer,
                                  int64_t solution,
                                  const char *name,
                                  double *number);

// Points of a solution by their name, "control_points" above all, as x, y, x, y, ...: writes at most `room` points,
// and always how many there are. SPIRAL_NONE where there are none of that name.
//
// # Safety
// `answer` is null or open; `name` is null or a text that ends with a zero byte; `xy` is null or has room for
// `2 * room` numbers; `count` is null or valid for a write.
SpiralStatus spiral_answer_points(const SpiralAnswer *answer,
                                  int64_t solution,
                                  const char *name,
                                  double (*xy)[2],
                                  size_t room,
                                  size_t *count);

// Opens an atlas file and checks its header and axes.
//
// # Safety
// `path` is a text that ends with a zero byte; `atlas` is valid for a write. Both may be null, which is
// SPIRAL_ARGUMENT.
SpiralStatus spiral_atlas_open(const char *path, SpiralAtlas **atlas);

// Closes an atlas. Null is allowed.
//
// # Safety
// `atlas` comes from spiral_atlas_open and is not used any more, nor are pointers that it gave.
void spiral_atlas_close(SpiralAtlas *atlas);

// The family's name; null for a null pointer. It lives as long as the atlas.
//
// # Safety
// `atlas` is null or open.
const char *spiral_atlas_family(const SpiralAtlas *atlas);

// The number of axes; 0 for a null pointer.
//
// # Safety
// `atlas` is null or open.
size_t spiral_atlas_axes(const SpiralAtlas *atlas);

// Name and values of an axis, slowest first. All live as long as the atlas.
//
// # Safety
// `atlas` is null or open; each of the others is null, when it is not wanted, or valid for a write.
SpiralStatus spiral_atlas_axis(const SpiralAtlas *atlas,
                               size_t index,
                               const char **name,
                               const double **values,
                               size_t *count);

// The mask of a flag, by name.
//
// # Safety
// `atlas` is null or open; `name` is null or a text that ends with a zero byte; `mask` is null or valid for a write.
SpiralStatus spiral_atlas_flag(const SpiralAtlas *atlas,
                               const char *name,
                               uint8_t *mask);

// The `flags` and `solutions` bytes of all nodes, in flat order, and their number. All live as long as the atlas.
//
// # Safety
// `atlas` is null or open; each of the others is null, when it is not wanted, or valid for a write.
SpiralStatus spiral_atlas_data(const SpiralAtlas *atlas,
                               const uint8_t **flags,
                               const uint8_t **solutions,
                               size_t *count);

// The nearest node of each of `count` points: its flat index, flags and solutions. A point outside the grid by more
// than half a step has the index -1, and 0 in both bytes. A verdict holds at its node.
//
// # Safety
// `atlas` is null or open; `points` holds `count` rows of as many numbers as there are axes; each of the others is
// null, when it is not wanted, or has room for `count` values.
SpiralStatus spiral_atlas_lookup(const SpiralAtlas *atlas,
                                 const double *points,
                                 size_t count,
                                 int64_t *nodes,
                                 uint8_t *flags,
                                 uint8_t *solutions);

// Reads the whole file and checks the hash of every array: SPIRAL_FILE names the first that is damaged.
//
// # Safety
// `atlas` is null or open.
SpiralStatus spiral_atlas_check(const SpiralAtlas *atlas);

// Opens a file of cells and checks its header, axes and trees.
//
// # Safety
// `path` is null or a text that ends with a zero byte; `cells` is null or valid for a write.
SpiralStatus spiral_cells_open(const char *path, SpiralCells **cells);

// Closes a file of cells. Null is allowed.
//
// # Safety
// `cells` comes from spiral_cells_open and is not used any more.
void spiral_cells_close(SpiralCells *cells);

// The number of coordinates of a point; 0 for a null pointer.
//
// # Safety
// `cells` is null or open.
size_t spiral_cells_axes(const SpiralCells *cells);

// The mask of a flag, by name.
//
// # Safety
// `cells` is null or open; `name` is null or a text that ends with a zero byte; `mask` is null or valid for a write.
SpiralStatus spiral_cells_flag(const SpiralCells *cells,
                               const char *name,
                               uint8_t *mask);

// What the cell of each of `count` points says, as two masks: flags that hold at every point of the cell, and flags
// that hold at none. A flag in neither is not known; outside the box of the file none is.
//
// # Safety
// `cells` is null or open; `points` holds `count` rows of as many numbers as there are axes; `inside` and `outside`
// are null, when they are not wanted, or have room for `count` values.
SpiralStatus spiral_cells_lookup(const SpiralCells *cells,
                                 const double *points,
                                 size_t count,
                                 uint8_t *inside,
                                 uint8_t *outside);

// The truth about the wanted flags at each of `count` points: from its cell where that says it, or else from the
// family itself, also outside the box. A point outside the family's domain is SPIRAL_DOMAIN, naming the row.
//
// # Safety
// `cells` is null or open; `points` holds `count` rows of as many numbers as there are axes; `holds` has room for
// `count` values.
SpiralStatus spiral_cells_verdict(const SpiralCells *cells,
                                  const double *points,
                                  size_t count,
                                  uint8_t wanted,
                                  uint8_t *holds);

// The curve of monotone curvature between two ends anywhere in the plane.
//
// `kind` is "cubic" (of several spirals the one with the largest margin), "ph-quintic" (that of least bending energy)
// or "involute" (the image of an involute of a circle, which exists whenever any spiral does); null stands for
// "cubic". A curve longer than `longest` counts as none; infinity is no limit. SPIRAL_NONE where there is no spiral:
// the last error says which condition fails.
//
// # Safety
// `start`, `end`, `kind` and `curve` are null or valid; `kind` ends with a zero byte.
SpiralStatus spiral_fit(const SpiralEnd *start,
                        const SpiralEnd *end,
                        const char *kind,
                        double longest,
                        SpiralCurve **curve);

// A path of proved spirals, arcs and lines from one state to another, with continuous curvature that never exceeds
// `greatest_curvature`, with spirals of the kind "cubic", "ph-quintic", "trig-quintic", "involute" or "clothoid" (null
// stands for "cubic"): of the joins tried the one that has least of the `objective`, "length", "greatest-curvature",
// "greatest-rate" (of change of curvature) or "bending-energy" (null stands for "length"). A path longer than
// `longest`, or of more than `most_pieces` pieces, counts as none; infinity and SIZE_MAX are no limits. SPIRAL_NONE
// where none was found: the last error says why.
//
// # Safety
// `start`, `end`, `kind`, `objective` and `curve` are null or valid; `kind` and `objective` end with a zero byte.
SpiralStatus spiral_join(const SpiralEnd *start,
                         const SpiralEnd *end,
                         double greatest_curvature,
                         const char *kind,
                         const char *objective,
                         double longest,
                         size_t most_pieces,
                         SpiralCurve **curve);

// Closes a curve. Null is allowed.
//
// # Safety
// `curve` comes from spiral_fit or spiral_join and is not used any more, nor are pointers that it gave.
void spiral_curve_close(SpiralCurve *curve);

// "cubic", "ph-quintic", "trig-quintic", "involute", "clothoid", "line" or "arc"; "path" of several pieces; null for a
// null pointer. It lives as long as the curve.
//
// # Safety
// `curve` is null or open.
const char *spiral_curve_kind(const SpiralCurve *curve);

// All that rebuilds the curve exactly, in JSON: the piece as `curve` has it, or {"pieces": [..]} of several;
// null for a null pointer. It lives as long as the curve.
//
// # Safety
// `curve` is null or open.
const char *spiral_curve_json(const SpiralCurve *curve);

// Arc length; NaN for a null pointer.
//
// # Safety
// `curve` is null or open.
double spiral_curve_length(const SpiralCurve *curve);

// Control points: writes at most `room` of them, and always how many there are: 0 for what has none, an involute, a
// clothoid, a line, an arc, or a curve of several pieces.
//
// # Safety
// `curve` is null or open; `xy` is null or has room for `room` points; `count` is null or valid for a write.
SpiralStatus spiral_curve_control_points(const SpiralCurve *curve,
                                         double (*xy)[2],
                                         size_t room,
                                         size_t *count);

// `count` points at equal arc lengths, both ends included; at least 2.
//
// # Safety
// `curve` is null or open; `out` has room for `count` stations.
SpiralStatus spiral_curve_stations(const SpiralCurve *curve, SpiralStation *out, size_t count);

// Answers a request to a path tool: "hermite", "equal-length", "least-curvature", "spline", "plan", "separation" or
// "measure". `request` is a JSON object with the fields of docs/path.md; the options of the commands are fields too:
// `minimum` of separation, `samples` and `offset` of measure, `paper` of equal-length. The answer is what the command
// prints; where there is no path such as was asked for, its `paths` is empty, and its `reason` says why. Close the
// report with spiral_report_close.
//
// # Safety
// `tool` and `request` are null or texts that end with a zero byte; `report` is null or valid for a write.
SpiralStatus spiral_path(const char *tool,
                         const char *request,
                         SpiralReport **report);

// The answer in JSON. It lives as long as the report, and is null for a null report.
//
// # Safety
// `report` is null or comes from spiral_path and is not closed.
const char *spiral_report_json(const SpiralReport *report);

// Closes a report. Null is allowed.
//
// # Safety
// `report` comes from spiral_path and is not used any more, nor is its text.
void spiral_report_close(SpiralReport *report);

// All intervals of the coordinate number `axis`, from `from` to `to`, in which a property holds; in `datum` that
// coordinate does not matter. `flag` is the property's name; null stands for the flag that says that a spiral exists.
// All families answer. Close the ranges with spiral_ranges_close.
//
// # Safety
// `family`, `chart` and `flag` are null or texts that end with a zero byte (a null `chart` is the family's first);
// `datum` holds as many numbers as the chart has axes; `ranges` is null or valid for a write.
SpiralStatus spiral_ranges(const char *family,
                           const char *chart,
                           const char *flag,
                           const double *datum,
                           size_t axis,
                           double from,
                           double to,
                           SpiralRanges **ranges);

// Closes ranges. Null is allowed.
//
// # Safety
// `ranges` comes from spiral_ranges and is not used any more, nor are pointers that it gave.
void spiral_ranges_close(SpiralRanges *ranges);

// The ranges in increasing order, and the intervals of which it is not known whether the property holds there; outside
// of both it is proved to fail. All live as long as the handle.
//
// # Safety
// `ranges` is null or open; each of the others is null, when it is not wanted, or valid for a write.
SpiralStatus spiral_ranges_data(const SpiralRanges *ranges,
                                const SpiralRange **all,
                                size_t *count,
                                const double (**open)[2],
                                size_t *open_count);

// The nearest datum that has a property, of those with coordinates up to 1e6: the datum, its distance, and a proved
// bound: no datum with the property is nearer than `at_least`. The distance is the root of the sum of squares of
// weight times difference; null `weights` are 1, and an infinite one keeps its coordinate. SPIRAL_NONE where no datum
// was found; then `at_least` alone is written, infinite where there is none at all.
//
// # Safety
// `family`, `chart`, `flag` and `datum` as for spiral_ranges; `weights` is null or holds as many numbers as the datum;
// `nearest` is null, when it is not wanted, or has room for as many; `distance` and `at_least` are null, when they are
// not wanted, or valid for a write.
SpiralStatus spiral_nearest(const char *family,
                            const char *chart,
                            const char *flag,
                            const double *datum,
                            const double *weights,
                            double *nearest,
                            double *distance,
                            double *at_least);

// The outline of a property in a slice: the coordinates with the numbers `axes[0]` and `axes[1]` vary, each from
// `within[i][0]` to `within[i][1]`, in `cells` cells along each side: a power of two up to 4096. In `datum` these two
// do not matter. Close the outline with spiral_boundary_close.
//
// # Safety
// `family`, `chart`, `flag` and `datum` as for spiral_ranges; `axes` and `within` are null or hold two numbers and two
// pairs; `boundary` is null or valid for a write.
SpiralStatus spiral_boundary(const char *family,
                             const char *chart,
                             const char *flag,
                             const double *datum,
                             const size_t *axes,
                             const double (*within)[2],
                             size_t cells,
                             SpiralBoundary **boundary);

// Closes an outline. Null is allowed.
//
// # Safety
// `boundary` comes from spiral_boundary and is not used any more, nor are pointers that it gave.
void spiral_boundary_close(SpiralBoundary *boundary);

// How many polylines the outline has; 0 for a null pointer.
//
// # Safety
// `boundary` is null or open.
size_t spiral_boundary_lines(const SpiralBoundary *boundary);

// A polyline of the outline: its points, and 1 where the last joins the first, 0 where it ends at the border of the
// slice. The points live as long as the handle.
//
// # Safety
// `boundary` is null or open; each of the others is null, when it is not wanted, or valid for a write.
SpiralStatus spiral_boundary_line(const SpiralBoundary *boundary,
                                  size_t index,
                                  const double (**xy)[2],
                                  size_t *count,
                                  uint8_t *closed);

// Cells, as their least and greatest corners, in which the property may change although no line passes; and the sides
// of a cell, two numbers. It is proved to change in no other cell but those that a line passes. The cells live as long
// as the handle.
//
// # Safety
// `boundary` is null or open; `open` and `count` are null, when they are not wanted, or valid for a write; `cell` is
// null, when it is not wanted, or has room for two numbers.
SpiralStatus spiral_boundary_open(const SpiralBoundary *boundary,
                                  const double (**open)[2][2],
                                  size_t *count,
                                  double *cell);

// In a sentence, what was wrong with the last call of this thread that did not return SPIRAL_OK. It stays valid until
// the thread's next such call; it is never null.
const char *spiral_last_error(void);

// The library's version, such as "0.1.0".
const char *spiral_version(void);

#ifdef __cplusplus
}  // extern "C"
#endif  // __cplusplus

#endif  /* SPIRAL_ATLAS_H */
