// What certified cells save in an OMPL planner whose motions are single cubic spirals: RRT in a scene with a wall, with
// the same random numbers and so the same answers, testing each candidate by spiral_atlas::fit alone (`fit`), after a
// look at the signs of its angles and curvatures (`signs`), or after that and a lookup of its cell (`cells`). In the
// folder of the project:
//
//     spiral-atlas generate RECIPE                       # of cells of the cubic, as in docs/cells.md
//     crates/capi/install PREFIX
//     export PKG_CONFIG_PATH=PREFIX/lib/pkgconfig
//     g++ -std=c++17 -O2 -Icpp benches/ompl_atlas.cpp -o ompl_atlas $(pkg-config --cflags --libs spiral_atlas ompl)
//     LD_LIBRARY_PATH=PREFIX/lib ./ompl_atlas CELLS fit|signs|cells [CANDIDATES]

#include "spiral_atlas_cells.hpp"
#include "spiral_atlas_ompl.hpp"

#include <ompl/geometric/SimpleSetup.h>
#include <ompl/geometric/planners/rrt/RRT.h>
#include <ompl/util/Console.h>
#include <ompl/util/RandomNumbers.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>

namespace ob = ompl::base;
namespace og = ompl::geometric;
namespace sa = spiral_atlas;

using Clock = std::chrono::steady_clock;

enum class Test { fit, signs, cells };

struct Counts {
    std::size_t candidates = 0, by_signs = 0, by_cells = 0, spirals = 0;
    double deciding = 0;
};

/// The candidate in the frame of the cubic family: half the chord is 1, the curve turns left ever more sharply.
static bool datum(const sa::End &a, const sa::End &b, double (&point)[4]) {
    const double dx = b.x - a.x, dy = b.y - a.y, half = std::hypot(dx, dy) / 2, chord = std::atan2(dy, dx);
    const double tau = 6.283185307179586;
    const double alpha = std::remainder(a.direction - chord, tau), beta = std::remainder(b.direction - chord, tau);
    const double start = a.curvature * half, end = b.curvature * half;
    const double side = alpha < 0 && beta > 0 ? 1 : -1;
    double first[2] = {-side * alpha, side * start}, last[2] = {side * beta, side * end};
    if (first[1] > last[1]) std::swap(first, last);
    point[0] = first[0], point[1] = last[0], point[2] = first[1], point[3] = last[1];
    return point[0] > 0 && point[1] > 0 && point[2] >= 0;
}

class Validator : public ob::MotionValidator {
public:
    Validator(const ob::SpaceInformationPtr &si, Test test, const sa::CellsFile &cells, Counts &counts)
        : MotionValidator(si), test_(test), cells_(cells), spiral_(cells.flag("SPIRAL")), counts_(counts) {}

    bool checkMotion(const ob::State *from, const ob::State *to) const override {
        const sa::End a = sa::JoinStateSpace::read(from), b = sa::JoinStateSpace::read(to);
        const auto began = Clock::now();
        const auto curve = spiral(a, b);
        counts_.deciding += std::chrono::duration<double>(Clock::now() - began).count();
        counts_.candidates++;
        if (!curve) return false;
        counts_.spirals++;
        ob::State *state = si_->allocState();
        bool valid = true;
        for (const auto &at : curve->stations(static_cast<std::size_t>(curve->length() / 0.05) + 2)) {
            sa::JoinStateSpace::write(state, at.x, at.y, at.heading, std::clamp(at.curvature, -1.0, 1.0));
            valid = valid && si_->isValid(state);
        }
        si_->freeState(state);
        return valid;
    }

    bool checkMotion(const ob::State *from, const ob::State *to, std::pair<ob::State *, double> &last) const override {
        last.second = 0;
        return checkMotion(from, to);
    }

private:
    Test test_;
    const sa::CellsFile &cells_;
    std::uint8_t spiral_;
    Counts &counts_;

    std::optional<sa::Curve> spiral(const sa::End &a, const sa::End &b) const {
        double point[4];
        if (test_ != Test::fit) {
            if (!datum(a, b, point)) return counts_.by_signs++, std::nullopt;
            if (test_ == Test::cells && cells_.lookup(point, spiral_) == sa::Cell::outside)
                return counts_.by_cells++, std::nullopt;
        }
        return sa::fit(a, b);
    }
};

int main(int count, char **arguments) {
    const sa::CellsFile cells(arguments[1]);
    const std::string name = arguments[2];
    const Test test = name == "fit" ? Test::fit : name == "signs" ? Test::signs : Test::cells;
    const std::size_t candidates = count > 3 ? std::strtoul(arguments[3], nullptr, 10) : 100000;
    ompl::msg::setLogLevel(ompl::msg::LOG_ERROR);
    ompl::RNG::setSeed(1);
    Counts counts;
    double whole = 0;
    int solved = 0, runs = 0;
    // Each run is stopped after a tenth of the candidates, or at a path.
    while (counts.candidates < candidates) {
        const std::size_t most = counts.candidates + candidates / 10;
        auto space = std::make_shared<sa::JoinStateSpace>(1.0);
        ob::RealVectorBounds bounds(2);
        bounds.setLow(-2), bounds.setHigh(14);
        space->setBounds(bounds);
        og::SimpleSetup setup(space);
        const auto &si = setup.getSpaceInformation();
        setup.setStateValidityChecker([&](const ob::State *state) {
            const sa::End at = sa::JoinStateSpace::read(state);
            return si->satisfiesBounds(state) && !(at.x > 4.9 && at.x < 6.1 && at.y > 0.9 && at.y < 9.1);
        });
        si->setMotionValidator(std::make_shared<Validator>(si, test, cells, counts));
        ob::ScopedState<sa::JoinStateSpace> start(space), goal(space);
        sa::JoinStateSpace::write(start.get(), 0, 5, 0, 0.1);
        sa::JoinStateSpace::write(goal.get(), 12, 5, 0, 0.2);
        setup.setStartAndGoalStates(start, goal, 1e-9);
        auto planner = std::make_shared<og::RRT>(si);
        planner->setRange(1e6);
        setup.setPlanner(planner);
        setup.setup();
        const auto began = Clock::now();
        const ob::PlannerTerminationCondition enough([&] { return counts.candidates >= most; });
        solved += setup.solve(enough) == ob::PlannerStatus::EXACT_SOLUTION;
        runs++;
        whole += std::chrono::duration<double>(Clock::now() - began).count();
    }
    std::printf("%s: %d of %d solved in %.3f s, %.3f s of them to decide %zu candidates: ", name.c_str(), solved, runs,
                whole, counts.deciding, counts.candidates);
    std::printf("no by signs %zu, by cells %zu; spirals %zu\n", counts.by_signs, counts.by_cells, counts.spirals);
}
