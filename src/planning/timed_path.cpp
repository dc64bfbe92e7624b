#include "planning/timed_path.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>

#include <fmt/format.h>

#include "base/require.h"
#include "dynamics/inverse_dynamics.h"
#include "dynamics/joint_springs.h"
#include "scene/state.h"

namespace rex {
namespace {

// The least over all joints that share a coordinate; infinite if none has a limit.
Eigen::VectorXd velocitiesOf(const Model& model) {
  Eigen::VectorXd least = Eigen::VectorXd::Constant(model.nv(), std::numeric_limits<double>::infinity());
  for (const Joint& joint : model.joints()) {
    const double scale = joint.mimics ? std::abs(joint.ratio) : 1;
    if (!(joint.maxVelocity > 0) || !(scale > 0)) continue;
    for (int i = joint.vIndex; i < joint.vIndex + joint.nv; ++i)
      least[i] = std::min(least[i], joint.maxVelocity / scale);
  }
  return least;
}

// The effort of a joint that mimics is part of that of its target.
Eigen::VectorXd effortsOf(const Model& model) {
  Eigen::VectorXd efforts = Eigen::VectorXd::Constant(model.nv(), std::numeric_limits<double>::infinity());
  for (const Joint& joint : model.joints())
    if (!joint.mimics && joint.maxEffort > 0)
      efforts.segment(joint.vIndex, joint.nv).setConstant(joint.maxEffort);
  return efforts;
}

}  // namespace

JointLimits jointLimits(const Model& model, const LimitDefaults& defaults) {
  requirePositive("velocity of joints without a limit", defaults.velocity);
  requirePositive("seconds to the velocity limit", defaults.ramp);
  const std::vector<std::string> names = velocityNames(model);
  JointLimits result{.limits = {.velocity = velocitiesOf(model), .names = names}};
  MotionLimits& limits = result.limits;
  for (Eigen::Index i = 0; i < model.nv(); ++i) {
    if (std::isfinite(limits.velocity[i])) continue;
    limits.velocity[i] = defaults.velocity;
    result.assumedVelocity.push_back(names[static_cast<std::size_t>(i)]);
  }
  limits.acceleration = limits.velocity / defaults.ramp;
  if (!defaults.effort) return result;
  limits.effort = effortsOf(model);
  for (Eigen::Index i = 0; i < model.nv(); ++i)
    if (!std::isfinite(limits.effort[i])) result.anyEffort.push_back(names[static_cast<std::size_t>(i)]);
  limits.forces =
      [model = std::make_shared<const Model>(model), workspace = std::make_shared<DynamicsWorkspace>()](
          const VectorArg& q, const VectorArg& v, const VectorArg& a, Eigen::Ref<Eigen::VectorXd> u) {
        inverseDynamics(*model, q, v, a, earthGravity(), *workspace, u);
        if (model->hasSprings()) u -= springForces(*model, q);
      };
  return result;
}

TimedPath::TimedPath(PathCurve curve, std::vector<Interval> intervals, std::vector<double> squares)
    : curve_(std::move(curve)), intervals_(std::move(intervals)), squares_(std::move(squares)) {
  assert(intervals_.empty() || squares_.size() == intervals_.size() + 1);
  for (std::size_t i = 0; i < intervals_.size(); ++i) {
    const double way = intervals_[i].to - intervals_[i].from;
    places_.push_back(places_.back() + way);
    times_.push_back(times_.back() + 2 * way / (std::sqrt(squares_[i]) + std::sqrt(squares_[i + 1])));
  }
}

MotionPoint TimedPath::at(double t) const {
  requireFinite("time on a path", t);
  if (intervals_.empty()) {
    const Eigen::VectorXd rest = Eigen::VectorXd::Zero(curve_.start.size());
    return {curve_.start, rest, rest};
  }
  const double time = std::clamp(t, 0., duration());
  const auto next = std::upper_bound(times_.begin() + 1, times_.end() - 1, time);
  const auto i = static_cast<std::size_t>(next - times_.begin()) - 1;
  const Interval& interval = intervals_[i];
  const double way = interval.to - interval.from, past = time - times_[i];
  const double speed = std::sqrt(squares_[i]), growth = (squares_[i + 1] - squares_[i]) / (2 * way);
  double s = interval.from + past * (speed + growth * past / 2), rate = speed + growth * past;
  if (time >= times_[i + 1]) s = interval.to, rate = std::sqrt(squares_[i + 1]);
  CurvePoint point;
  curve_.pieces[interval.piece].at(std::clamp(s, interval.from, interval.to), point);
  return {point.q, rate * point.dq, growth * point.dq + rate * rate * point.ddq};
}

}  // namespace rex
