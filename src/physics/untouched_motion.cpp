#include <algorithm>
#include <cmath>
#include <utility>

#include "base/error.h"
#include "physics/joint_row_internal.h"
#include "physics/untouched_motion_internal.h"

namespace rex::internal {
namespace {

// Turns of a joint in a step, radians: up to the first, Beeman's method keeps the energy; beyond, steps are
// cut so that Runge's and Kutta's does, up to the last.
constexpr double kSmallTurn = 0.01, kMostTurn = 1;

bool isPlain(const Joint& joint, const PhysicsOptions& options) {
  if (joint.mimics || (joint.type != JointType::kHinge && joint.type != JointType::kRigid)) return false;
  return !options.jointFriction || (joint.damping == 0 && joint.friction == 0);
}

}  // namespace

UntouchedMotion::UntouchedMotion(const Model& model, const PhysicsOptions& options)
    : model_(&model),
      isAble_(std::ranges::all_of(model.joints(), [&](const Joint& one) { return isPlain(one, options); })),
      hasLimits_(options.jointLimits),
      stepper_(model, {.integrator = Integrator::kBeeman, .gravity_W = options.gravity_W}),
      fastStepper_(model, {.gravity_W = options.gravity_W}),
      u_(Eigen::VectorXd::Zero(model.nv())) {}

void UntouchedMotion::setMotors(std::span<const Motor> motors) {
  hasForcesOnly_ =
      std::ranges::all_of(motors, [](const Motor& one) { return one.kind == Motor::Kind::kForce; });
  for (std::size_t i = 0; i < motors.size(); ++i) u_[static_cast<Eigen::Index>(i)] = motors[i].target;
}

bool UntouchedMotion::isWithinLimits(const Model& model, const State& state, double h) const {
  for (Eigen::Index i = 0; i < state.q.size(); ++i) {
    const double reach = kLimitReach + 2 * h * std::abs(state.v[i]);
    if (state.q[i] - model.lowerLimits()[i] <= reach || model.upperLimits()[i] - state.q[i] <= reach)
      return false;
  }
  return true;
}

bool UntouchedMotion::step(State& state, double h) {
  const double turn = state.v.lpNorm<Eigen::Infinity>() * h;
  if (!isAble_ || !hasForcesOnly_ || !(turn < kMostTurn)) return false;
  if (hasLimits_ && !isWithinLimits(*model_, state, h)) return false;
  try {
    if (turn < kSmallTurn) {
      stepper_.step(state, u_, h);
    } else {
      next_ = state;
      const int count = static_cast<int>(std::ceil(turn / kSmallTurn));
      for (int i = 0; i < count; ++i) fastStepper_.step(next_, u_, h / count);
      std::swap(state, next_);
    }
    return true;
  } catch (const Error&) {
    return false;  // the state is as it was, and the caller's own step tells what is wrong
  }
}

}  // namespace rex::internal
