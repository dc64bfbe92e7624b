#include <algorithm>
#include <cmath>
#include <utility>

#include "base/error.h"
#include "physics/untouched_motion_internal.h"

namespace rex::internal {
namespace {

// Turns of a joint in a step, radians: up to the first, Beeman's method keeps the energy; beyond, steps are
// cut so that Runge's and Kutta's does, up to the last.
constexpr double kSmallTurn = 0.01, kMostTurn = 1;

bool isHinge(const Joint& joint) {
  return !joint.mimics && (joint.type == JointType::kHinge || joint.type == JointType::kRigid);
}

}  // namespace

UntouchedMotion::UntouchedMotion(const Model& model, const PhysicsOptions& options)
    : model_(&model),
      gravity_W_(options.gravity_W),
      isAble_(model.pins().empty() && std::ranges::all_of(model.joints(), isHinge)),
      motors_(static_cast<std::size_t>(model.nv())),
      impulses_(isAble_ ? model.nv() : 0),
      u_(Eigen::VectorXd::Zero(model.nv())),
      p_(u_),
      v_(u_) {
  if (!isAble_) return;
  stepper_.emplace(model, StepperOptions{.integrator = Integrator::kBeeman, .gravity_W = options.gravity_W});
  fastStepper_.emplace(model, StepperOptions{.gravity_W = options.gravity_W});
  laws_.resize(static_cast<std::size_t>(model.nv()));
  for (const Joint& joint : model.joints()) {
    if (joint.nv == 0) continue;
    const JointLaw law = jointLaw(model, joint, 0, options);
    laws_[static_cast<std::size_t>(joint.vIndex)] = law;
    resists_ = resists_ || law.damping > 0 || law.friction > 0;
  }
}

void UntouchedMotion::setMotors(std::span<const Motor> motors) {
  motors_.assign(motors.begin(), motors.end());
  hasForcesOnly_ = true;
  for (std::size_t i = 0; i < motors.size(); ++i) {
    const bool isForce = motors[i].kind == Motor::Kind::kForce;
    hasForcesOnly_ = hasForcesOnly_ && isForce;
    u_[static_cast<Eigen::Index>(i)] = isForce ? motors[i].target : 0;
  }
}

void UntouchedMotion::reset() {
  if (stepper_) stepper_->reset();
  impulses_.reset();
}

bool UntouchedMotion::onlyForcesAct(const State& state, double h) const {
  if (resists_ || !hasForcesOnly_) return false;
  for (Eigen::Index i = 0; i < state.q.size(); ++i) {
    const JointLaw& law = laws_[static_cast<std::size_t>(i)];
    const double reach = kLimitReach + 2 * h * std::abs(state.v[i]);
    if (state.q[i] - law.lower <= reach || law.upper - state.q[i] <= reach) return false;
  }
  return true;
}

void UntouchedMotion::stepFreely(State& state, double h, int count) {
  if (count == 1) return stepper_->step(state, u_, h);
  next_ = state;
  for (int i = 0; i < count; ++i) fastStepper_->step(next_, u_, h / count);
  std::swap(state, next_);
}

bool UntouchedMotion::stepWithGoals(State& state, double h) {
  equationOfMotion(*model_, state.q, state.v, gravity_W_, workspace_, motion_);
  p_ = h * (u_ - motion_.F);
  p_.noalias() += motion_.M * state.v;
  for (Eigen::Index i = 0; i < p_.size(); ++i) {
    const auto k = static_cast<std::size_t>(i);
    impulses_.set(i, jointGoals(laws_[k], motors_[k], state.q[i], state.v[i], h));
  }
  v_ = state.v;
  if (!impulses_.solve(motion_.M, p_, v_) || !v_.allFinite()) return false;
  state.v = v_;
  state.q += h * v_;
  return true;
}

bool UntouchedMotion::step(State& state, double h) {
  const double turn = state.v.lpNorm<Eigen::Infinity>() * h;
  if (!isAble_ || !(turn < kMostTurn)) return false;
  try {
    if (!onlyForcesAct(state, h)) return stepWithGoals(state, h);
    stepFreely(state, h, std::max(1, static_cast<int>(std::ceil(turn / kSmallTurn))));
    return true;
  } catch (const Error&) {
    return false;  // the state is as it was, and the caller's own step tells what is wrong
  }
}

}  // namespace rex::internal
