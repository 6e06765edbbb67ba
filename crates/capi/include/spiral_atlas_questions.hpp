/* Questions beyond yes and no, in C++17: ranges, the nearest datum, outlines. spiral_atlas.hpp includes it.
 *
 * `datum` are the coordinates in the order of the chart's axes; an empty `chart` is the family's first, and an empty
 * `flag` the one that says that a spiral exists. See docs/questions.md. */

#ifndef SPIRAL_ATLAS_QUESTIONS_HPP
#define SPIRAL_ATLAS_QUESTIONS_HPP

#include "spiral_atlas.hpp"

namespace spiral_atlas {

using Range = SpiralRange;

/// All that is known of a property along one coordinate.
struct Ranges {
    std::vector<Range> ranges;               ///< in increasing order
    std::vector<std::array<double, 2>> open; ///< where it is not known whether the property holds
};

/// All intervals of the coordinate number `axis`, within two numbers, in which a property holds; in `datum` that
/// coordinate does not matter.
inline Ranges ranges(const std::string &family, View<const double> datum, std::size_t axis,
                     std::array<double, 2> within, const std::string &flag = {}, const std::string &chart = {}) {
    detail::check_datum(family, chart, datum);
    SpiralRanges *handle = nullptr;
    detail::check(spiral_ranges(family.c_str(), detail::optional(chart), detail::optional(flag), datum.data(), axis,
                                within[0], within[1], &handle));
    const detail::Handle<SpiralRanges, spiral_ranges_close> owner(handle);
    const SpiralRange *all = nullptr;
    const double(*open)[2] = nullptr;
    std::size_t count = 0, open_count = 0;
    detail::check(spiral_ranges_data(handle, &all, &count, &open, &open_count));
    Ranges found{{all, all + count}, {}};
    for (std::size_t i = 0; i < open_count; i++) found.open.push_back({open[i][0], open[i][1]});
    return found;
}

/// The nearest datum with a property.
struct Nearest {
    std::optional<std::vector<double>> point; ///< none where none was found
    double distance = std::numeric_limits<double>::infinity();
    double at_least = 0; ///< proved: no datum with the property is nearer
};

/// The nearest datum that has a property. `weights` are 1 where there are none; an infinite one keeps its coordinate.
inline Nearest nearest(const std::string &family, View<const double> datum, View<const double> weights = {},
                       const std::string &flag = {}, const std::string &chart = {}) {
    detail::check_datum(family, chart, datum);
    if (!weights.empty() && weights.size() != datum.size())
        throw Error(SPIRAL_ARGUMENT, "a weight for each coordinate is needed");
    Nearest found;
    std::vector<double> point(datum.size());
    const SpiralStatus status =
        spiral_nearest(family.c_str(), detail::optional(chart), detail::optional(flag), datum.data(), weights.data(),
                       point.data(), &found.distance, &found.at_least);
    if (status == SPIRAL_NONE) return found;
    detail::check(status);
    found.point = std::move(point);
    return found;
}

/// The outline of a property in a slice. It changes in no cell but those that a line passes and open ones: proved.
struct Boundary {
    struct Line {
        bool closed; ///< the last point joins the first; others end at the border of the slice
        std::vector<std::array<double, 2>> points;
    };
    std::vector<Line> lines;
    std::vector<std::array<std::array<double, 2>, 2>> open; ///< least and greatest corners of cells
    std::array<double, 2> cell;                             ///< sides of a cell
};

/// The outline in the slice in which the coordinates with the numbers `axes` vary within `within`, in `cells` cells
/// along each side: a power of two up to 4096.
inline Boundary boundary(const std::string &family, View<const double> datum, std::array<std::size_t, 2> axes,
                         std::array<std::array<double, 2>, 2> within, std::size_t cells = 256,
                         const std::string &flag = {},
                         const std::string &chart = {}) {
    detail::check_datum(family, chart, datum);
    const double box[2][2] = {{within[0][0], within[0][1]}, {within[1][0], within[1][1]}};
    SpiralBoundary *handle = nullptr;
    detail::check(spiral_boundary(family.c_str(), detail::optional(chart), detail::optional(flag), datum.data(),
                                  axes.data(), box, cells, &handle));
    const detail::Handle<SpiralBoundary, spiral_boundary_close> owner(handle);
    Boundary found{};
    for (std::size_t i = 0; i < spiral_boundary_lines(handle); i++) {
        const double(*xy)[2] = nullptr;
        std::size_t count = 0;
        std::uint8_t closed = 0;
        detail::check(spiral_boundary_line(handle, i, &xy, &count, &closed));
        Boundary::Line line{closed != 0, {}};
        for (std::size_t k = 0; k < count; k++) line.points.push_back({xy[k][0], xy[k][1]});
        found.lines.push_back(std::move(line));
    }
    const double(*open)[2][2] = nullptr;
    std::size_t count = 0;
    detail::check(spiral_boundary_open(handle, &open, &count, found.cell.data()));
    for (std::size_t i = 0; i < count; i++)
        found.open.push_back({{{open[i][0][0], open[i][0][1]}, {open[i][1][0], open[i][1][1]}}});
    return found;
}

} // namespace spiral_atlas

#endif
