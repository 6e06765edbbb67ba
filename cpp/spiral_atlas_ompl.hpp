/* OMPL: a state space whose motions are proved joins. C++17, over spiral_atlas.hpp and OMPL 1.5 or newer.
 *
 * A state is a pose with a curvature, SE(2) x kappa. The motion between two states is the shortest join found: spirals
 * whose curvature is proved to be monotone, arcs and lines. So position, direction and curvature are continuous along
 * a whole path, and |curvature| never exceeds the limit of the space. Joins go forwards only: motions are not
 * symmetric.
 *
 * Steering can fail: between two states there may be no join. checkMotion() is false then, and interpolate() gives the
 * second state. Set the planner's range so large that motions are not cut (a state in the middle of a join is often
 * not reached by a shorter one), and use planners that build their tree from the start: RRT, RRTstar, EST.
 * docs/planners.md has an example and figures.
 *
 * SPDX-License-Identifier: MIT OR Apache-2.0 */

#ifndef SPIRAL_ATLAS_OMPL_HPP
#define SPIRAL_ATLAS_OMPL_HPP

#include <spiral_atlas.hpp>

#include <ompl/base/MotionValidator.h>
#include <ompl/base/OptimizationObjective.h>
#include <ompl/base/SpaceInformation.h>
#include <ompl/base/StateSpace.h>
#include <ompl/base/spaces/RealVectorStateSpace.h>
#include <ompl/base/spaces/SE2StateSpace.h>
#include <ompl/geometric/PathGeometric.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace spiral_atlas {

/// SE(2) x kappa, whose motions are joins.
class JoinStateSpace : public ompl::base::CompoundStateSpace {
public:
    /// `greatest_curvature` is the limit, and bounds the curvature of states. `kind` is what the spirals are.
    explicit JoinStateSpace(double greatest_curvature, std::string kind = "cubic")
        : greatest_curvature_(greatest_curvature), kind_(std::move(kind)) {
        setName("SpiralAtlasJoins" + getName());
        auto pose = std::make_shared<ompl::base::SE2StateSpace>();
        auto curvature = std::make_shared<ompl::base::RealVectorStateSpace>(1);
        curvature->setBounds(-greatest_curvature, greatest_curvature);
        addSubspace(pose, 1.0);
        // A full change of curvature counts as much as half a least radius.
        addSubspace(curvature, 0.25 / (greatest_curvature * greatest_curvature));
        lock();
    }

    /// Bounds of the positions.
    void setBounds(const ompl::base::RealVectorBounds &bounds) { as<ompl::base::SE2StateSpace>(0)->setBounds(bounds); }

    double greatestCurvature() const noexcept { return greatest_curvature_; }

    static End read(const ompl::base::State *state) {
        const auto *both = state->as<ompl::base::CompoundState>();
        const auto *pose = both->as<ompl::base::SE2StateSpace::StateType>(0);
        return {pose->getX(), pose->getY(), pose->getYaw(),
                both->as<ompl::base::RealVectorStateSpace::StateType>(1)->values[0]};
    }

    static void write(ompl::base::State *state, double x, double y, double direction, double curvature) {
        auto *both = state->as<ompl::base::CompoundState>();
        auto *pose = both->as<ompl::base::SE2StateSpace::StateType>(0);
        pose->setXY(x, y);
        pose->setYaw(std::remainder(direction, 6.283185307179586476925286766559));
        both->as<ompl::base::RealVectorStateSpace::StateType>(1)->values[0] = curvature;
    }

    /// The motion between two states; null where there is none. The last one of each thread is kept.
    std::shared_ptr<const Curve> motion(const ompl::base::State *from, const ompl::base::State *to) const {
        thread_local struct {
            const JoinStateSpace *space = nullptr;
            End from{}, to{};
            std::shared_ptr<const Curve> curve;
        } last;
        const End a = read(from), b = read(to);
        const auto same = [](const End &p, const End &q) {
            return p.x == q.x && p.y == q.y && p.direction == q.direction && p.curvature == q.curvature;
        };
        if (last.space != this || !same(last.from, a) || !same(last.to, b)) {
            last.curve.reset();
            // A state cannot be joined with itself.
            if (!same(a, b))
                if (auto curve = join(a, b, greatest_curvature_, kind_))
                    last.curve = std::make_shared<const Curve>(std::move(*curve));
            last.space = this;
            last.from = a;
            last.to = b;
        }
        return last.curve;
    }

    bool hasSymmetricInterpolate() const override { return false; }

    void interpolate(const ompl::base::State *from, const ompl::base::State *to, double t,
                     ompl::base::State *state) const override {
        const auto curve = t > 0 && t < 1 ? motion(from, to) : nullptr;
        if (!curve) {
            copyState(state, t > 0 ? to : from);
            return;
        }
        // The nearest of 1,025 points at equal lengths.
        const auto stations = curve->stations(1025);
        const auto &at = stations[static_cast<std::size_t>(std::lround(t * 1024))];
        write(state, at.x, at.y, at.heading, std::clamp(at.curvature, -greatest_curvature_, greatest_curvature_));
    }

private:
    double greatest_curvature_;
    std::string kind_;
};

/// A motion is valid where it is a join, and the states along it are valid, no farther apart than `spacing`.
///
/// Where the validity of a state means that nothing is nearer than spacing / 2, that proves the whole motion free: each
/// of its points is no farther than that from one that was checked.
class JoinMotionValidator : public ompl::base::MotionValidator {
public:
    JoinMotionValidator(const ompl::base::SpaceInformationPtr &si, double spacing)
        : MotionValidator(si), spacing_(spacing) {}

    bool checkMotion(const ompl::base::State *from, const ompl::base::State *to) const override {
        const auto curve = space()->motion(from, to);
        // A few states first: most motions that are not free show it there.
        return count(curve && valid(*curve, 16 * spacing_, nullptr) && valid(*curve, spacing_, nullptr));
    }

    bool checkMotion(const ompl::base::State *from, const ompl::base::State *to,
                     std::pair<ompl::base::State *, double> &last) const override {
        last.second = 0;
        if (last.first != nullptr) space()->copyState(last.first, from);
        const auto curve = space()->motion(from, to);
        return count(curve && valid(*curve, spacing_, &last));
    }

private:
    double spacing_;

    const JoinStateSpace *space() const { return si_->getStateSpace()->as<JoinStateSpace>(); }

    bool valid(const Curve &curve, double spacing, std::pair<ompl::base::State *, double> *last) const {
        const double steps = std::ceil(curve.length() / spacing);
        if (!(steps < 1e7)) return false;
        const auto stations = curve.stations(static_cast<std::size_t>(steps) + 1);
        const double limit = space()->greatestCurvature();
        ompl::base::State *state = si_->allocState();
        std::size_t i = 0;
        for (; i < stations.size(); i++) {
            const auto &at = stations[i];
            space()->write(state, at.x, at.y, at.heading, std::clamp(at.curvature, -limit, limit));
            if (!si_->isValid(state)) break;
            if (last == nullptr) continue;
            last->second = static_cast<double>(i) / steps;
            if (last->first != nullptr) space()->copyState(last->first, state);
        }
        si_->freeState(state);
        return i == stations.size();
    }

    bool count(bool valid) const {
        valid ? valid_++ : invalid_++;
        return valid;
    }
};

/// Least length, as the joins have it.
class JoinLengthObjective : public ompl::base::OptimizationObjective {
public:
    explicit JoinLengthObjective(const ompl::base::SpaceInformationPtr &si) : OptimizationObjective(si) {
        description_ = "Length of joins";
    }

    ompl::base::Cost stateCost(const ompl::base::State *) const override { return identityCost(); }

    ompl::base::Cost motionCost(const ompl::base::State *from, const ompl::base::State *to) const override {
        const auto curve = si_->getStateSpace()->as<JoinStateSpace>()->motion(from, to);
        return ompl::base::Cost(curve ? curve->length() : std::numeric_limits<double>::infinity());
    }

    ompl::base::Cost motionCostHeuristic(const ompl::base::State *from, const ompl::base::State *to) const override {
        const End a = JoinStateSpace::read(from), b = JoinStateSpace::read(to);
        return ompl::base::Cost(std::hypot(b.x - a.x, b.y - a.y));
    }

    bool isSymmetric() const override { return false; }
};

/// The curves of a path that a planner found, one for each pair of its states; none where one is no join.
inline std::optional<std::vector<std::shared_ptr<const Curve>>> curves(const ompl::geometric::PathGeometric &path) {
    const auto *space = path.getSpaceInformation()->getStateSpace()->as<JoinStateSpace>();
    std::vector<std::shared_ptr<const Curve>> all;
    for (std::size_t i = 1; i < path.getStateCount(); i++) {
        all.push_back(space->motion(path.getState(static_cast<unsigned>(i - 1)),
                                    path.getState(static_cast<unsigned>(i))));
        if (!all.back()) return std::nullopt;
    }
    return all;
}

} // namespace spiral_atlas

#endif
