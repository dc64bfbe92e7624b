#pragma once

#include <vector>

#include "dynamics/inverse_dynamics.h"
#include "dynamics/joint_forces.h"

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

  /// dv/dt (nv), with the forces that joints add. Throws Error as forwardDynamics and requireBounded.
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
  DynamicsWorkspace workspace_{};
  Eigen::VectorXd u_, forces_;
  double time_ = 0;
};

/// The name of the joint that q[i] or v[i] belongs to.
[[nodiscard]] const std::string& jointOfPosition(const Model& model, Eigen::Index i);
[[nodiscard]] const std::string& jointOfVelocity(const Model& model, Eigen::Index i);

}  // namespace rex::internal
