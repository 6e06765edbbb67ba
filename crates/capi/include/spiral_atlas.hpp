/* C++17 over spiral_atlas.h: handles that close themselves, views instead of pointers, exceptions instead of statuses.
 *
 * Errors are exceptions, all of them a spiral_atlas::Error with the library's sentence. That there is no spiral is no
 * error: fit() returns no value then, and gives the reason. See docs/cpp.md. */

#ifndef SPIRAL_ATLAS_HPP
#define SPIRAL_ATLAS_HPP

#include "spiral_atlas.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace spiral_atlas {

/// A call failed; what() is the library's sentence.
class Error : public std::runtime_error {
public:
    Error(SpiralStatus status, const char *what) : std::runtime_error(what), status_(status) {}
    SpiralStatus status() const noexcept { return status_; }

private:
    SpiralStatus status_;
};

/// A view of numbers side by side in memory: what std::span is in C++20. Containers with data() and size() turn into
/// it.
template <typename T> class View {
public:
    constexpr View() noexcept = default;
    constexpr View(T *data, std::size_t size) noexcept : data_(data), size_(size) {}
    template <std::size_t N> constexpr View(T (&array)[N]) noexcept : data_(array), size_(N) {}
    template <typename Container,
              typename = std::enable_if_t<!std::is_same_v<std::decay_t<Container>, View> &&
                                          std::is_convertible_v<decltype(std::declval<Container &>().data()), T *>>>
    constexpr View(Container &&container) noexcept : data_(container.data()), size_(container.size()) {}
    constexpr T *data() const noexcept { return data_; }
    constexpr std::size_t size() const noexcept { return size_; }
    constexpr bool empty() const noexcept { return size_ == 0; }
    constexpr T &operator[](std::size_t i) const noexcept { return data_[i]; }
    constexpr T *begin() const noexcept { return data_; }
    constexpr T *end() const noexcept { return data_ + size_; }

private:
    T *data_ = nullptr;
    std::size_t size_ = 0;
};

namespace detail {

inline void check(SpiralStatus status) {
    if (status != SPIRAL_OK) throw Error(status, spiral_last_error());
}

/// How many points a list of coordinates holds.
inline std::size_t rows(View<const double> points, std::size_t axes) {
    if (axes == 0 || points.size() % axes != 0) {
        const std::string what = std::to_string(points.size()) + " numbers; a point has " + std::to_string(axes);
        throw Error(SPIRAL_ARGUMENT, what.c_str());
    }
    return points.size() / axes;
}

inline const char *optional(const std::string &text) { return text.empty() ? nullptr : text.c_str(); }

/// How many data of a chart a list of coordinates holds.
inline std::size_t count_data(const std::string &family, const std::string &chart, View<const double> data) {
    std::size_t axes = 0;
    check(spiral_family_axes(family.c_str(), optional(chart), &axes));
    return rows(data, axes);
}

/// A datum must have as many coordinates as the chart has axes.
inline void check_datum(const std::string &family, const std::string &chart, View<const double> datum) {
    if (count_data(family, chart, datum) != 1) throw Error(SPIRAL_ARGUMENT, "one datum is needed");
}

template <typename T, void (*close)(T *)> struct Close {
    void operator()(T *handle) const noexcept { close(handle); }
};

template <typename T, void (*close)(T *)> using Handle = std::unique_ptr<T, Close<T, close>>;

} // namespace detail

inline std::string version() { return spiral_version(); }

/// An atlas of nodes, mapped into memory.
class Atlas {
public:
    struct Lookup {
        std::vector<std::int64_t> nodes; ///< flat indices; -1 outside the grid
        std::vector<std::uint8_t> flags;
        std::vector<std::uint8_t> solutions;
    };

    explicit Atlas(const std::string &path) {
        SpiralAtlas *atlas = nullptr;
        detail::check(spiral_atlas_open(path.c_str(), &atlas));
        handle_.reset(atlas);
    }

    std::string family() const { return spiral_atlas_family(handle_.get()); }
    std::size_t axes() const noexcept { return spiral_atlas_axes(handle_.get()); }

    std::string axis_name(std::size_t index) const {
        const char *name = nullptr;
        detail::check(spiral_atlas_axis(handle_.get(), index, &name, nullptr, nullptr));
        return name;
    }

    /// The values of an axis; they live as long as the atlas.
    View<const double> axis(std::size_t index) const {
        const double *values = nullptr;
        std::size_t count = 0;
        detail::check(spiral_atlas_axis(handle_.get(), index, nullptr, &values, &count));
        return {values, count};
    }

    /// The mask of a flag.
    std::uint8_t flag(const std::string &name) const {
        std::uint8_t mask = 0;
        detail::check(spiral_atlas_flag(handle_.get(), name.c_str(), &mask));
        return mask;
    }

    /// The flags of every node, last axis fastest; they live as long as the atlas.
    View<const std::uint8_t> flags() const {
        const std::uint8_t *flags = nullptr;
        std::size_t count = 0;
        detail::check(spiral_atlas_data(handle_.get(), &flags, nullptr, &count));
        return {flags, count};
    }

    /// The solutions byte of every node, as flags().
    View<const std::uint8_t> solutions() const {
        const std::uint8_t *solutions = nullptr;
        std::size_t count = 0;
        detail::check(spiral_atlas_data(handle_.get(), nullptr, &solutions, &count));
        return {solutions, count};
    }

    /// The nearest node of each point. `points` are coordinates, one point after another.
    Lookup lookup(View<const double> points) const {
        const std::size_t count = detail::rows(points, axes());
        Lookup found{std::vector<std::int64_t>(count), std::vector<std::uint8_t>(count),
                     std::vector<std::uint8_t>(count)};
        detail::check(spiral_atlas_lookup(handle_.get(), points.data(), count, found.nodes.data(), found.flags.data(),
                                          found.solutions.data()));
        return found;
    }

    /// Reads the whole file; throws where an array is damaged.
    void check() const { detail::check(spiral_atlas_check(handle_.get())); }

private:
    detail::Handle<SpiralAtlas, spiral_atlas_close> handle_;
};

/// Certified cells, mapped into memory.
class Cells {
public:
    /// What cells say: masks of flags that hold at every point, and of flags that hold at none.
    struct Known {
        std::vector<std::uint8_t> inside;
        std::vector<std::uint8_t> outside;
    };

    explicit Cells(const std::string &path) {
        SpiralCells *cells = nullptr;
        detail::check(spiral_cells_open(path.c_str(), &cells));
        handle_.reset(cells);
    }

    std::size_t axes() const noexcept { return spiral_cells_axes(handle_.get()); }

    std::uint8_t flag(const std::string &name) const {
        std::uint8_t mask = 0;
        detail::check(spiral_cells_flag(handle_.get(), name.c_str(), &mask));
        return mask;
    }

    /// What the cell of each point says.
    Known lookup(View<const double> points) const {
        const std::size_t count = detail::rows(points, axes());
        Known known{std::vector<std::uint8_t>(count), std::vector<std::uint8_t>(count)};
        detail::check(spiral_cells_lookup(handle_.get(), points.data(), count, known.inside.data(),
                                          known.outside.data()));
        return known;
    }

    /// The truth about the wanted flags at each point.
    std::vector<std::uint8_t> verdict(View<const double> points, std::uint8_t wanted = 255) const {
        const std::size_t count = detail::rows(points, axes());
        std::vector<std::uint8_t> holds(count);
        detail::check(spiral_cells_verdict(handle_.get(), points.data(), count, wanted, holds.data()));
        return holds;
    }

private:
    detail::Handle<SpiralCells, spiral_cells_close> handle_;
};

/// The mask of a family's flag.
inline std::uint8_t flag(const std::string &family, const std::string &name) {
    std::uint8_t mask = 0;
    detail::check(spiral_family_flag(family.c_str(), name.c_str(), &mask));
    return mask;
}

/// All that a family knows of a datum.
class Answer {
public:
    /// `datum` are the coordinates in the order of the chart's axes; an empty `chart` is the family's first.
    Answer(const std::string &family, View<const double> datum, const std::string &chart = {}) {
        detail::check_datum(family, chart, datum);
        SpiralAnswer *answer = nullptr;
        detail::check(spiral_solve(family.c_str(), detail::optional(chart), datum.data(), &answer));
        handle_.reset(answer);
        detail::check(spiral_answer_verdict(answer, &flags_, &counts_, &solutions_, &chosen_));
    }

    std::uint8_t flags() const noexcept { return flags_; }
    std::uint8_t counts() const noexcept { return counts_; }
    std::size_t solutions() const noexcept { return solutions_; }

    /// The index of the chosen solution, if there is one.
    std::optional<std::size_t> chosen() const {
        return chosen_ < 0 ? std::nullopt : std::optional<std::size_t>(static_cast<std::size_t>(chosen_));
    }

    /// A number of a solution by its name, such as "f0" or "margin".
    double number(std::size_t solution, const std::string &name) const {
        double x = 0;
        detail::check(spiral_answer_number(handle_.get(), static_cast<std::int64_t>(solution), name.c_str(), &x));
        return x;
    }

    /// Points of a solution by their name, such as "control_points".
    std::vector<std::array<double, 2>> points(std::size_t solution, const std::string &name) const {
        const auto index = static_cast<std::int64_t>(solution);
        std::size_t count = 0;
        detail::check(spiral_answer_points(handle_.get(), index, name.c_str(), nullptr, 0, &count));
        std::vector<std::array<double, 2>> all(count);
        auto *room = reinterpret_cast<double(*)[2]>(all.data());
        detail::check(spiral_answer_points(handle_.get(), index, name.c_str(), room, count, &count));
        return all;
    }

private:
    detail::Handle<SpiralAnswer, spiral_answer_close> handle_;
    std::uint8_t flags_ = 0, counts_ = 0;
    std::size_t solutions_ = 0;
    std::int64_t chosen_ = -1;
};

/// The proved verdicts of many data.
struct Verdicts {
    std::vector<std::uint8_t> flags;
    std::vector<std::uint8_t> solutions;
};

/// The verdicts of data, one after another in `data`; `threads` 0 stands for all cores.
inline Verdicts solve_batch(const std::string &family, View<const double> data, std::size_t threads = 0,
                            const std::string &chart = {}) {
    const std::size_t count = detail::count_data(family, chart, data);
    Verdicts all{std::vector<std::uint8_t>(count), std::vector<std::uint8_t>(count)};
    detail::check(spiral_solve_batch(family.c_str(), detail::optional(chart), data.data(), count, threads,
                                     all.flags.data(), all.solutions.data(), nullptr));
    return all;
}

/// The proved verdicts of many data, and their curves.
struct Curves : Verdicts {
    /// `each` points for a datum: those of the chosen curve in the family's frame, or NaN where there is none.
    std::vector<std::array<double, 2>> control_points;
    std::size_t each = 0;
};

/// `solve_batch`, with curves; an Error where the curves of the family have no control points.
inline Curves solve_batch_curves(const std::string &family, View<const double> data, std::size_t threads = 0,
                                 const std::string &chart = {}) {
    const std::size_t count = detail::count_data(family, chart, data);
    Curves all;
    detail::check(spiral_family_control_points(family.c_str(), &all.each));
    all.flags.resize(count), all.solutions.resize(count);
    // One more, so that there is a place even for none.
    all.control_points.resize(count * all.each + 1);
    auto *room = reinterpret_cast<double(*)[2]>(all.control_points.data());
    detail::check(spiral_solve_batch(family.c_str(), detail::optional(chart), data.data(), count, threads,
                                     all.flags.data(), all.solutions.data(), room));
    all.control_points.pop_back();
    return all;
}

using End = SpiralEnd;
using Station = SpiralStation;

/// A curve of one or more pieces.
class Curve {
public:
    double length() const noexcept { return spiral_curve_length(handle_.get()); }
    std::string kind() const { return spiral_curve_kind(handle_.get()); }

    /// All that rebuilds it exactly: the piece as `curve` has it, or {"pieces": [..]} of several.
    std::string json() const { return spiral_curve_json(handle_.get()); }

    /// Control points; an involute, a clothoid, a line, an arc and a curve of several pieces have none.
    std::vector<std::array<double, 2>> control_points() const {
        std::size_t count = 0;
        detail::check(spiral_curve_control_points(handle_.get(), nullptr, 0, &count));
        std::vector<std::array<double, 2>> all(count);
        auto *room = reinterpret_cast<double(*)[2]>(all.data());
        detail::check(spiral_curve_control_points(handle_.get(), room, count, &count));
        return all;
    }

    /// Points at equal arc lengths, both ends included; at least 2.
    std::vector<Station> stations(std::size_t count) const {
        std::vector<Station> all(count);
        detail::check(spiral_curve_stations(handle_.get(), all.data(), count));
        return all;
    }

private:
    friend std::optional<Curve> fit(const End &, const End &, const std::string &, double, std::string *);
    friend std::optional<Curve> join(const End &, const End &, double, const std::string &, const std::string &, double,
                                     std::size_t, std::string *);
    explicit Curve(SpiralCurve *curve) : handle_(curve) {}
    detail::Handle<SpiralCurve, spiral_curve_close> handle_;
};

/// The curve of monotone curvature between two ends, or none; then `reason`, where it is given, says why.
///
/// `kind` is "cubic", "ph-quintic" or "involute"; a curve longer than `longest` counts as none.
inline std::optional<Curve> fit(const End &start, const End &end, const std::string &kind = "cubic",
                                double longest = std::numeric_limits<double>::infinity(),
                                std::string *reason = nullptr) {
    SpiralCurve *curve = nullptr;
    const SpiralStatus status = spiral_fit(&start, &end, kind.c_str(), longest, &curve);
    if (status == SPIRAL_NONE) {
        if (reason != nullptr) *reason = spiral_last_error();
        return std::nullopt;
    }
    detail::check(status);
    return Curve(curve);
}

/// A path from one state to another by proved spirals, arcs and lines, with continuous curvature that never exceeds
/// `greatest_curvature`, or none; then `reason`, where it is given, says why.
///
/// `kind` is "cubic", "ph-quintic", "trig-quintic", "involute" or "clothoid". Of the joins tried it is the one with the
/// least "length", "greatest-curvature", "greatest-rate" or "bending-energy", as `objective` says. A join longer than
/// `longest`, or of more than `most_pieces` pieces, counts as none.
inline std::optional<Curve> join(const End &start, const End &end, double greatest_curvature,
                                 const std::string &kind = "cubic", const std::string &objective = "length",
                                 double longest = std::numeric_limits<double>::infinity(),
                                 std::size_t most_pieces = std::numeric_limits<std::size_t>::max(),
                                 std::string *reason = nullptr) {
    SpiralCurve *curve = nullptr;
    const SpiralStatus status = spiral_join(&start, &end, greatest_curvature, kind.c_str(), objective.c_str(), longest,
                                            most_pieces, &curve);
    if (status == SPIRAL_NONE) {
        if (reason != nullptr) *reason = spiral_last_error();
        return std::nullopt;
    }
    detail::check(status);
    return Curve(curve);
}

/// Answers a request to a path tool, such as "spline" or "plan", with what the command `path` prints: JSON in and out.
inline std::string path(const std::string &tool, const std::string &request) {
    SpiralReport *handle = nullptr;
    detail::check(spiral_path(tool.c_str(), request.c_str(), &handle));
    const detail::Handle<SpiralReport, spiral_report_close> owner(handle);
    return spiral_report_json(handle);
}

} // namespace spiral_atlas

#include "spiral_atlas_questions.hpp"

#endif
