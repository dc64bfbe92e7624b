#include "planning/motion_limits.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include <fmt/format.h>

#include "base/require.h"
#include "dynamics/inverse_dynamics.h"
#include "scene/coordinate_names.h"

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
      };
  return result;
}

}  // namespace rex
