#include "live/hold.h"

#include <cmath>
#include <limits>

#include <Eigen/Cholesky>

#include "control/computed_torque.h"
#include "dynamics/mass_matrix.h"
#include "scene/coordinates.h"

namespace rex {
namespace {

constexpr double kStiffness = 0.1;  // seconds: wave length of the held joints, which are critically damped

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

Holder::Holder(const Model& model, Hold hold, const Eigen::VectorXd& q, const Eigen::Vector3d& gravity_W)
    : model_(model), hold_(hold), gravity_W_(gravity_W), target_(standAt(model, q)) {
  if (hold == Hold::kPd || hold == Hold::kGravity) inertia_ = massMatrix(model, q).diagonal();
  const std::vector<bool> carries = carriers(model);
  for (std::size_t j = 0; j < carries.size(); ++j) {
    const Joint& joint = model.joints()[j];
    if (joint.type != JointType::kFree || joint.mimics) continue;
    for (int i = joint.vIndex; i < joint.vIndex + joint.nv; ++i) {
      undriven_.push_back(i);
      if (carries[j]) carrying_.push_back(i);
    }
  }
}

Eigen::VectorXd Holder::forces(const State& state) const {
  Eigen::VectorXd u = Eigen::VectorXd::Zero(model_.nv());
  if (hold_ == Hold::kExact) u = exactForces(state);
  if (hold_ == Hold::kGravity || hold_ == Hold::kPd) {
    const PdGains gains = pdGains(1, kStiffness, 1);
    u = inertia_.cwiseProduct(followReference(model_, state, target_, gains));
    if (hold_ == Hold::kGravity) u += gravityForces(model_, state.q, gravity_W_);
  }
  for (const int i : undriven_) u[i] = 0;
  return u;
}

// Free bases fall: they accelerate so that no force on them is needed.
Eigen::VectorXd Holder::exactForces(const State& state) const {
  const PdGains gains = pdGains(1, kStiffness, 1);
  if (carrying_.empty()) return computedTorque(model_, state, target_, gains, gravity_W_);
  Eigen::VectorXd a = followReference(model_, state, target_, gains);
  for (const int i : undriven_) a[i] = 0;
  const auto [M, F] = equationOfMotion(model_, state.q, state.v, gravity_W_);
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
    const double most = joint.maxEffort > 0 ? joint.maxEffort : std::numeric_limits<double>::infinity();
    for (int i = 0; i < joint.nv; ++i)
      motors[static_cast<std::size_t>(joint.vIndex + i)] = {Motor::Kind::kPosition,
                                                            target_.q[joint.qIndex + i], most};
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
