#include "live/hold.h"

#include <cmath>
#include <limits>

#include <Eigen/Cholesky>

#include "control/computed_torque.h"
#include "dynamics/equations_of_motion.h"
#include "dynamics/forward_dynamics.h"
#include "dynamics/joint_springs.h"
#include "scene/state.h"

namespace rex {
namespace {

// For each joint, whether it is a free joint that carries driven joints.
std::vector<bool> carriers(const Model& model) {
  std::vector<bool> carries(model.joints().size());
  for (const Joint& joint : model.joints()) {
    if (joint.type == JointType::kFree || joint.nv == 0) continue;
    for (BodyId at = joint.parent; at != kWorld; at = model[at].parent) {
      const JointId above = model[at].joint;
      if (above != kNoJoint && model[above].type == JointType::kFree)
        carries[static_cast<std::size_t>(above)] = true;
    }
  }
  return carries;
}

double effortLimit(const Joint& joint) {
  return joint.maxEffort > 0 ? joint.maxEffort : std::numeric_limits<double>::infinity();
}

}  // namespace

std::string toString(Hold hold) {
  switch (hold) {
    case Hold::kNone:
      return "free";
    case Hold::kExact:
      return "held";
    case Hold::kGravity:
      return "held against gravity";
    case Hold::kPd:
      return "held by springs";
    case Hold::kMotor:
      return "held by motors";
  }
  return "";
}

bool hasFloatingBase(const Model& model) {
  for (const bool carries : carriers(model))
    if (carries) return true;
  return false;
}

Holder::Holder(const Model& model, Hold hold, const Eigen::VectorXd& q, const Eigen::Vector3d& gravity_W,
               double tau)
    : model_(model),
      hold_(hold),
      gravity_W_(gravity_W),
      tau_(tau),
      target_(standAt(model, q)),
      efforts_(Eigen::VectorXd::Constant(model.nv(), std::numeric_limits<double>::infinity())) {
  const std::vector<bool> carries = carriers(model);
  for (std::size_t j = 0; j < carries.size(); ++j) {
    const Joint& joint = model.joints()[j];
    if (joint.type != JointType::kFree || joint.mimics) continue;
    for (int i = joint.vIndex; i < joint.vIndex + joint.nv; ++i) {
      undriven_.push_back(i);
      if (carries[j]) carrying_.push_back(i);
    }
  }
  for (const Joint& joint : model.joints())
    if (!joint.mimics) efforts_.segment(joint.vIndex, joint.nv).setConstant(effortLimit(joint));
  if (hold != Hold::kPd && hold != Hold::kGravity) return;
  const PdGains gains = pdGains(1, kHoldWave, 1);
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(model.nv());
  static_cast<void>(forwardDynamics(model, q, none, none));  // names a joint that moves no mass
  const Eigen::VectorXd masses = massMatrix(model, q).diagonal();
  Kp_ = gains.Kp * masses, Kd_ = gains.Kd * masses;
  for (const int i : undriven_) Kp_[i] = Kd_[i] = 0;
}

Eigen::VectorXd Holder::forces(const State& state) const {
  Eigen::VectorXd u = Eigen::VectorXd::Zero(model_.nv());
  if (hold_ == Hold::kExact) u = exactForces(state);
  if (hold_ == Hold::kGravity || hold_ == Hold::kPd) u = springForces(state);
  for (const int i : undriven_) u[i] = 0;
  return u;
}

// With the velocity w at the end of the step, u = G + Kp (q* - q - tau w) - Kd w and M (w - v) = tau (u - F).
Eigen::VectorXd Holder::springForces(const State& state) const {
  auto [M, F] = equationOfMotion(model_, state.q, state.v, gravity_W_);
  const Eigen::VectorXd pull = rex::springForces(model_, state.q);
  F -= pull;
  Eigen::VectorXd u = Kp_.cwiseProduct(difference(model_, state.q, target_.q));
  if (hold_ == Hold::kGravity) {
    Eigen::VectorXd weight = gravityForces(model_, state.q, gravity_W_) - pull;
    for (const int i : undriven_) weight[i] = 0;
    u += weight;
  }
  const Eigen::VectorXd momentum = M * state.v + tau_ * (u - F);
  const Eigen::VectorXd damping = Kd_ + tau_ * Kp_;
  M.diagonal() += tau_ * damping;
  u -= damping.cwiseProduct(M.llt().solve(momentum));
  return u.cwiseMax(-efforts_).cwiseMin(efforts_);
}

// Free bases fall: they accelerate so that no force on them is needed.
Eigen::VectorXd Holder::exactForces(const State& state) const {
  const PdGains gains = pdGains(1, kHoldWave, 1);
  if (carrying_.empty()) return computedTorque(model_, state, target_, gains, gravity_W_);
  Eigen::VectorXd a = followReference(model_, state, target_, gains);
  for (const int i : undriven_) a[i] = 0;
  auto [M, F] = equationOfMotion(model_, state.q, state.v, gravity_W_);
  F -= rex::springForces(model_, state.q);
  const Eigen::VectorXd u = M * a + F;
  const Eigen::VectorXd missing = -u(carrying_);
  const Eigen::MatrixXd base = M(carrying_, carrying_);
  const Eigen::VectorXd fall = base.llt().solve(missing);
  a(carrying_) = fall;
  return M * a + F;
}

std::vector<Motor> Holder::motors(const Eigen::VectorXd& u) const {
  std::vector<Motor> motors;
  for (const double force : u) motors.push_back({.target = force});
  if (hold_ != Hold::kMotor) return motors;
  for (const Joint& joint : model_.joints()) {
    if (joint.mimics || joint.nq != joint.nv) continue;
    for (int i = 0; i < joint.nv; ++i)
      motors[static_cast<std::size_t>(joint.vIndex + i)] = {Motor::Kind::kPosition,
                                                            target_.q[joint.qIndex + i], effortLimit(joint)};
  }
  return motors;
}

std::vector<std::string> Holder::unheld() const {
  std::vector<std::string> names;
  if (hold_ != Hold::kMotor) return names;
  for (const Joint& joint : model_.joints())
    if (!joint.mimics && joint.nq != joint.nv && joint.type != JointType::kFree) names.push_back(joint.name);
  return names;
}

}  // namespace rex
