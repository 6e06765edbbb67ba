// RRT and RRT* among polygons, with joins. Every path is checked here from the JSON of its pieces, by formulas of this
// file: points, directions and curvatures meet, curvature is monotone in each piece and within the limit, and no point
// of it is nearer to a polygon than the clearance. Beside it OMPL's own Dubins curves, for times and lengths.
//
//     ompl SEED [SECONDS for RRT*]

#include "spiral_atlas_ompl.hpp"

#include "../crates/capi/tests/check.hpp"

#include <ompl/base/goals/GoalState.h>
#include <ompl/base/ScopedState.h>
#include <ompl/base/objectives/PathLengthOptimizationObjective.h>
#include <ompl/base/spaces/DubinsStateSpace.h>
#include <ompl/geometric/SimpleSetup.h>
#include <ompl/geometric/planners/rrt/RRT.h>
#include <ompl/geometric/planners/rrt/RRTstar.h>
#include <ompl/util/Console.h>
#include <ompl/util/RandomNumbers.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>

namespace ob = ompl::base;
namespace og = ompl::geometric;
namespace sa = spiral_atlas;

using Point = std::array<double, 2>;
using Polygon = std::vector<Point>;

struct Scene {
    const char *name;
    sa::End start, goal;
    std::vector<Polygon> obstacles;
};

static Polygon box(double x0, double y0, double x1, double y1) { return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}; }

static const double limit = 1.0, clearance = 0.1, spacing = 0.05;

static double distance(const Polygon &polygon, double x, double y) {
    double least = 1e300;
    bool inside = false;
    for (std::size_t i = 0; i < polygon.size(); i++) {
        const Point a = polygon[i], b = polygon[(i + 1) % polygon.size()];
        const double dx = b[0] - a[0], dy = b[1] - a[1];
        const double t = std::clamp(((x - a[0]) * dx + (y - a[1]) * dy) / (dx * dx + dy * dy), 0.0, 1.0);
        least = std::min(least, std::hypot(a[0] + t * dx - x, a[1] + t * dy - y));
        if ((a[1] > y) != (b[1] > y) && x < a[0] + (y - a[1]) / dy * dx) inside = !inside;
    }
    return inside ? -least : least;
}

static double distance(const Scene &scene, double x, double y) {
    double least = 1e300;
    for (const auto &polygon : scene.obstacles) least = std::min(least, distance(polygon, x, y));
    return least;
}

/// A number after a name in JSON that this file reads no further.
static std::vector<double> numbers(const std::string &text) {
    std::vector<double> all;
    for (std::size_t i = 0; i < text.size();) {
        char *end = nullptr;
        const double x = (text[i] == '-' || (text[i] >= '0' && text[i] <= '9')) ? std::strtod(&text[i], &end) : 0;
        if (end != nullptr) {
            all.push_back(x);
            i = static_cast<std::size_t>(end - text.data());
        } else {
            i++;
        }
    }
    return all;
}

static std::vector<double> field(const std::string &piece, const std::string &name) {
    const auto at = piece.find("\"" + name + "\":");
    CHECK(at != std::string::npos);
    std::size_t end = at + name.size() + 3;
    int depth = 0;
    do {
        depth += piece[end] == '[' ? 1 : piece[end] == ']' ? -1 : 0;
        end++;
    } while (end < piece.size() && (depth > 0 || (piece[end] != ',' && piece[end] != '}')));
    return numbers(piece.substr(at + name.size() + 3, end - at - name.size() - 3));
}

struct At {
    double x, y, heading, curvature;
};

/// A piece by its own formula: at the share t.
static At at(const std::string &piece, double t) {
    if (piece.find("\"kind\":\"line\"") != std::string::npos) {
        const auto a = field(piece, "start"), b = field(piece, "end");
        return {a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1]), std::atan2(b[1] - a[1], b[0] - a[0]), 0};
    }
    if (piece.find("\"kind\":\"arc\"") != std::string::npos) {
        const auto a = field(piece, "start");
        const double h = field(piece, "direction")[0], k = field(piece, "curvature")[0];
        const double s = t * field(piece, "length")[0];
        return {a[0] + (std::sin(h + k * s) - std::sin(h)) / k, a[1] - (std::cos(h + k * s) - std::cos(h)) / k,
                h + k * s, k};
    }
    const auto p = field(piece, "control_points");
    CHECK(p.size() == 8);
    const double u = 1 - t;
    double d[3][2] = {};
    for (int i = 0; i < 2; i++) {
        const auto c = [&](int j) { return p[static_cast<std::size_t>(2 * j + i)]; };
        d[0][i] = u * u * u * c(0) + 3 * u * u * t * c(1) + 3 * u * t * t * c(2) + t * t * t * c(3);
        d[1][i] = 3 * (u * u * (c(1) - c(0)) + 2 * u * t * (c(2) - c(1)) + t * t * (c(3) - c(2)));
        d[2][i] = 6 * (u * (c(2) - 2 * c(1) + c(0)) + t * (c(3) - 2 * c(2) + c(1)));
    }
    const double speed = std::hypot(d[1][0], d[1][1]);
    return {d[0][0], d[0][1], std::atan2(d[1][1], d[1][0]),
            (d[1][0] * d[2][1] - d[1][1] * d[2][0]) / (speed * speed * speed)};
}

static std::vector<std::string> pieces(const std::string &json) {
    std::vector<std::string> all;
    for (std::size_t from = json.find("{\"kind\""); from != std::string::npos;) {
        const std::size_t next = json.find("{\"kind\"", from + 1);
        all.push_back(json.substr(from, next == std::string::npos ? next : next - from));
        from = next;
    }
    return all;
}

/// The length of a path, after everything has been checked.
static double checked(const Scene &scene, const std::vector<std::shared_ptr<const sa::Curve>> &path) {
    At before{scene.start.x, scene.start.y, scene.start.direction, scene.start.curvature};
    double length = 0;
    const auto meet = [](const At &a, const At &b) {
        CHECK(std::hypot(a.x - b.x, a.y - b.y) < 1e-9 &&
              std::abs(std::remainder(a.heading - b.heading, 2 * M_PI)) < 1e-9);
        CHECK(std::abs(a.curvature - b.curvature) < 1e-9);
    };
    for (const auto &curve : path) {
        for (const auto &piece : pieces(curve->json())) {
            meet(before, at(piece, 0));
            const double rise = at(piece, 1).curvature - at(piece, 0).curvature;
            At last = at(piece, 0);
            const int steps = 400;
            for (int i = 1; i <= steps; i++) {
                const At now = at(piece, static_cast<double>(i) / steps);
                const double step = std::hypot(now.x - last.x, now.y - last.y);
                CHECK(std::abs(now.curvature) <= limit * (1 + 1e-9) &&
                      (now.curvature - last.curvature) * rise >= -1e-9);
                CHECK(distance(scene, now.x, now.y) >= clearance - step);
                length += step;
                last = now;
            }
            before = at(piece, 1);
        }
    }
    meet(before, {scene.goal.x, scene.goal.y, scene.goal.direction, scene.goal.curvature});
    return length;
}

static ob::RealVectorBounds bounds() {
    ob::RealVectorBounds bounds(2);
    bounds.setLow(-2);
    bounds.setHigh(14);
    return bounds;
}

static double seconds_since(std::chrono::steady_clock::time_point started) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
}

/// Time to the first solution and its length.
struct Found {
    double seconds, length;
};

template <typename Planner> static Found joins(const Scene &scene, double seconds) {
    auto space = std::make_shared<sa::JoinStateSpace>(limit);
    space->setBounds(bounds());
    og::SimpleSetup setup(space);
    const auto &si = setup.getSpaceInformation();
    // A state is valid where nothing is nearer than the clearance and half a step.
    setup.setStateValidityChecker([&](const ob::State *state) {
        const sa::End at = sa::JoinStateSpace::read(state);
        return si->satisfiesBounds(state) && distance(scene, at.x, at.y) >= clearance + spacing / 2;
    });
    si->setMotionValidator(std::make_shared<sa::JoinMotionValidator>(si, spacing));
    setup.setOptimizationObjective(std::make_shared<sa::JoinLengthObjective>(si));
    ob::ScopedState<sa::JoinStateSpace> start(space), goal(space);
    sa::JoinStateSpace::write(start.get(), scene.start.x, scene.start.y, scene.start.direction, scene.start.curvature);
    sa::JoinStateSpace::write(goal.get(), scene.goal.x, scene.goal.y, scene.goal.direction, scene.goal.curvature);
    setup.setStartAndGoalStates(start, goal, 1e-9);
    auto planner = std::make_shared<Planner>(si);
    planner->setRange(1e6);
    planner->setGoalBias(0.2);
    setup.setPlanner(planner);
    const auto started = std::chrono::steady_clock::now();
    // How far a planner comes in its time depends on the machine: without a path there is nothing to check.
    if (setup.solve(seconds) != ob::PlannerStatus::EXACT_SOLUTION) return {seconds_since(started), std::nan("")};
    const double took = seconds_since(started);
    const auto path = sa::curves(setup.getSolutionPath());
    CHECK(path);
    return {took, checked(scene, *path)};
}

static Found dubins(const Scene &scene) {
    auto space = std::make_shared<ob::DubinsStateSpace>(1 / limit);
    space->setBounds(bounds());
    og::SimpleSetup setup(space);
    const auto &si = setup.getSpaceInformation();
    setup.setStateValidityChecker([&](const ob::State *state) {
        const auto *at = state->as<ob::SE2StateSpace::StateType>();
        return si->satisfiesBounds(state) && distance(scene, at->getX(), at->getY()) >= clearance + spacing / 2;
    });
    ob::ScopedState<ob::DubinsStateSpace> start(space), goal(space);
    start->setXY(scene.start.x, scene.start.y);
    start->setYaw(scene.start.direction);
    goal->setXY(scene.goal.x, scene.goal.y);
    goal->setYaw(scene.goal.direction);
    setup.setStartAndGoalStates(start, goal, 1e-9);
    auto planner = std::make_shared<og::RRT>(si);
    planner->setRange(1e6);
    planner->setGoalBias(0.2);
    setup.setPlanner(planner);
    setup.setup();
    space->setLongestValidSegmentFraction(spacing / space->getMaximumExtent());
    const auto started = std::chrono::steady_clock::now();
    CHECK(setup.solve(60.0) == ob::PlannerStatus::EXACT_SOLUTION);
    return {seconds_since(started), setup.getSolutionPath().length()};
}

int main(int count, char **arguments) {
    const auto seed = static_cast<std::uint_fast32_t>(count > 1 ? std::atoi(arguments[1]) : 1);
    const double seconds = count > 2 ? std::atof(arguments[2]) : 2;
    ompl::msg::setLogLevel(ompl::msg::LOG_ERROR);
    ompl::RNG::setSeed(seed);
    const std::vector<Scene> scenes{
        {"open", {0, 0, 0, 0}, {8, 6, 1.5, 0}, {}},
        {"wall", {0, 5, 0, 0}, {12, 5, 0, 0.2}, {box(5, 1, 6, 9)}},
        {"slalom", {0, 0, 0.5, 0.3}, {12, 12, 0, 0}, {box(3, -2, 4, 5), box(7, 7, 8, 14), {{9, 0}, {13, 1}, {11, 3}}}},
        {"room", {1, 1, 1.57, 0}, {11, 11, 3.1, -0.5}, {box(5, -2, 6, 4), box(5, 6.5, 6, 14), box(8, 5, 9, 10)}},
    };
    std::printf("%-8s %24s %24s %24s\n", "scene", "joins, RRT: s, length", "joins, RRT*: s, length",
                "Dubins, RRT: s, length");
    for (const Scene &scene : scenes) {
        const Found rrt = joins<og::RRT>(scene, 60), star = joins<og::RRTstar>(scene, seconds), curves = dubins(scene);
        CHECK(std::isfinite(rrt.length));
        if (scene.obstacles.empty()) CHECK(star.length < 12);
        std::printf("%-8s %15.3f %8.2f %15.3f %8.2f %15.3f %8.2f\n", scene.name, rrt.seconds, rrt.length, star.seconds,
                    star.length, curves.seconds, curves.length);
    }
    // Random pairs within ten least radii: how many are joined, how much longer than Dubins' curves, and the time of
    // each.
    const std::size_t pairs = 5000;
    auto dubins_space = std::make_shared<ob::DubinsStateSpace>(1 / limit);
    ompl::RNG random;
    std::vector<std::pair<sa::End, sa::End>> ends;
    const auto end = [&] {
        return sa::End{random.uniformReal(-5, 5), random.uniformReal(-5, 5), random.uniformReal(-M_PI, M_PI),
                       random.uniformReal(-limit, limit)};
    };
    for (std::size_t i = 0; i < pairs; i++) ends.emplace_back(end(), end());
    std::size_t joined = 0;
    double length = 0, least = 0;
    std::vector<double> lengths(pairs, std::nan("")), times(pairs);
    for (std::size_t i = 0; i < pairs; i++) {
        const auto began = std::chrono::steady_clock::now();
        if (const auto curve = sa::join(ends[i].first, ends[i].second, limit)) lengths[i] = curve->length();
        times[i] = seconds_since(began) * 1e6;
    }
    ob::ScopedState<ob::DubinsStateSpace> from(dubins_space), to(dubins_space);
    const auto began = std::chrono::steady_clock::now();
    for (std::size_t i = 0; i < pairs; i++) {
        const auto &[p, q] = ends[i];
        from->setXY(p.x, p.y);
        from->setYaw(p.direction);
        to->setXY(q.x, q.y);
        to->setYaw(q.direction);
        const double shortest = dubins_space->distance(from.get(), to.get());
        if (std::isnan(lengths[i])) continue;
        // No curve within the limit is shorter.
        CHECK(lengths[i] > shortest - 1e-6);
        joined++;
        length += lengths[i];
        least += shortest;
    }
    const double each = seconds_since(began) / static_cast<double>(pairs) * 1e6;
    std::sort(times.begin(), times.end());
    std::printf("%zu random pairs, %.2f %% joined, %.3f times as long as Dubins' curves; "
                "us a join: median %.0f, 99 %% %.0f; a Dubins curve %.2f\n",
                pairs, 100.0 * static_cast<double>(joined) / static_cast<double>(pairs), length / least,
                times[pairs / 2], times[pairs * 99 / 100], each);
    CHECK(joined * 100 > pairs * 99);
    // Between a state and itself there is no motion, and none leaves the limit.
    auto space = std::make_shared<sa::JoinStateSpace>(limit);
    space->setBounds(bounds());
    ob::ScopedState<sa::JoinStateSpace> a(space), b(space), c(space);
    sa::JoinStateSpace::write(a.get(), 0, 0, 0, 0);
    sa::JoinStateSpace::write(b.get(), 5, 2, 7, 0.5);
    CHECK(space->motion(a.get(), a.get()) == nullptr && space->motion(a.get(), b.get()) != nullptr);
    for (const double t : {0.0, 0.3, 1.0}) {
        space->interpolate(a.get(), b.get(), t, c.get());
        CHECK(std::abs(sa::JoinStateSpace::read(c.get()).curvature) <= limit);
    }
    CHECK(sa::JoinStateSpace::read(c.get()).x == 5);
    std::puts("OMPL: all as it should be");
}
