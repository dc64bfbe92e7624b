#pragma once

#include <utility>
#include <vector>

#include "dynamics/inverse_dynamics.h"
#include "dynamics/joint_forces.h"
#include "dynamics/wrench.h"

namespace rex::internal {

/// How the states of a model change while the forces u of its joints are held: the right-hand side that
/// integrators step along. It allocates only when it is made.
class HeldMotion {
 public:
  /// Where a quaternion stands in q, and its angular velocity in v.
  struct QuaternionPlace {
    int qIndex = 0, vIndex = 0;
  };

  HeldMotion(const Model& model, const Eigen::Vector3d& gravity_W, const JointForces& jointForces);

  const Model& model() const { return model_; }
  double time() const { return time_; }
  const std::vector<QuaternionPlace>& quaternions() const { return quaternions_; }

  /// What holds until the next call: u, and the time that errors name.
  void hold(const VectorArg& u, double time);
  /// What pushes until the next call: none at first.
  void push(std::vector<Wrench> wrenches) { wrenches_ = std::move(wrenches); }

  /// dv/dt (nv), with the forces that joints and wrenches add. Throws Error as forwardDynamics and
  /// requireBounded.
  void accelerate(const Eigen::VectorXd& q, const Eigen::VectorXd& v, Eigen::VectorXd& a);
  /// dq/dt (nq): v, and of quaternions q o (0, v) / 2. Linear in q, so they need not be unit ones.
  void rate(const Eigen::VectorXd& q, const Eigen::VectorXd& v, Eigen::VectorXd& dq) const;
  /// Moves q on by d (nv), as rex::integrate, and makes quaternions unit ones.
  void move(Eigen::VectorXd& q, const Eigen::VectorXd& d) const;
  void normalize(Eigen::VectorXd& q) const;

  /// Throws Error naming time and joint where a velocity is beyond that of light, or a number is not finite.
  void requireBounded(const Eigen::VectorXd& q, const Eigen::VectorXd& v) const;

 private:
  Model model_;
  Eigen::Vector3d gravity_W_;
  JointForces jointForces_;
  std::vector<QuaternionPlace> quaternions_;
  std::vector<Wrench> wrenches_{};
  DynamicsWorkspace workspace_{};
  Eigen::VectorXd u_, forces_, added_;  // forces_: u_ and all that is added
  double time_ = 0;
};

}  // namespace rex::internal
