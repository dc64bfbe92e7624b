#pragma once

#include "control/linear_system.h"
#include "dynamics/derivatives.h"

namespace rex {

/// The motion of a robot in steps, for planners such as ilqr(): x = (q, v), and joint forces u that are held
/// for a step. It consists of semi-implicit Euler steps: v' = v + h a(q, v, u), q' = q + h v'.
class RobotSteps {
 public:
  /// `step` in seconds, of so many parts. The model must outlive this. Throws Error for a model with
  /// quaternions, a step that is not positive, and fewer parts than one.
  RobotSteps(const Model& model, double step, int parts = 1,
             const Eigen::Vector3d& gravity_W = earthGravity());

  /// The next state. Throws as forwardDynamics, and for an x of the wrong size.
  [[nodiscard]] Eigen::VectorXd next(const Eigen::VectorXd& x, const Eigen::VectorXd& u);
  /// Its exact derivatives. Throws as next().
  [[nodiscard]] MotionJacobians derivative(const Eigen::VectorXd& x, const Eigen::VectorXd& u);

 private:
  void move(Eigen::VectorXd& x) const;

  const Model& model_;
  double h_;
  int parts_;
  Eigen::Vector3d gravity_W_;
  Eigen::VectorXd stiffness_;  // of springs, nv
  Eigen::VectorXd forces_{};   // u and those of springs
  DynamicsWorkspace workspace_{};
  ForwardDynamicsDerivatives at_{};
};

}  // namespace rex
