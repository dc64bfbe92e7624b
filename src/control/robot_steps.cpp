#include "control/robot_steps.h"

#include <fmt/format.h>

#include "base/error.h"
#include "dynamics/forward_dynamics.h"
#include "dynamics/joint_springs.h"

namespace rex {

RobotSteps::RobotSteps(const Model& model, double step, int parts, const Eigen::Vector3d& gravity_W)
    : model_(model),
      h_(step / parts),
      parts_(parts),
      gravity_W_(gravity_W),
      stiffness_(Eigen::VectorXd::Zero(model.nv())) {
  if (model.nq() != model.nv())
    throw Error({.what = fmt::format("steps of '{}'", model.name()),
                 .found = "a joint with a quaternion",
                 .wanted = "joints whose positions are sums of velocities"});
  requirePositive("step of a robot", step);
  requireCount("parts of a step", parts, 1);
  for (const Joint& joint : model.joints())
    stiffness_.segment(joint.vIndex, joint.nv).array() += joint.ratio * joint.ratio * joint.stiffness;
}

// With the acceleration in at_.
void RobotSteps::move(Eigen::VectorXd& x) const {
  const int n = model_.nv();
  x.tail(n) += h_ * at_.a;
  x.head(n) += h_ * x.tail(n);
}

Eigen::VectorXd RobotSteps::next(const Eigen::VectorXd& x, const Eigen::VectorXd& u) {
  const int n = model_.nv();
  requireSize("state x", x.size(), 2 * n);
  Eigen::VectorXd y = x;
  at_.a.resize(n);
  for (int i = 0; i < parts_; ++i) {
    forces_ = u;
    addSpringForces(model_, y.head(n), forces_);
    forwardDynamics(model_, y.head(n), y.tail(n), forces_, gravity_W_, workspace_, at_.a);
    move(y);
  }
  return y;
}

MotionJacobians RobotSteps::derivative(const Eigen::VectorXd& x, const Eigen::VectorXd& u) {
  const int n = model_.nv();
  requireSize("state x", x.size(), 2 * n);
  Eigen::VectorXd y = x;
  // Of q and v by x and u.
  Eigen::MatrixXd Q = Eigen::MatrixXd::Identity(n, 3 * n), V = Eigen::MatrixXd::Zero(n, 3 * n);
  V.middleCols(n, n).setIdentity();
  for (int i = 0; i < parts_; ++i) {
    forces_ = u;
    addSpringForces(model_, y.head(n), forces_);
    forwardDynamicsDerivatives(model_, y.head(n), y.tail(n), forces_, gravity_W_, workspace_, at_);
    if (model_.hasSprings()) at_.a_q -= at_.a_u * stiffness_.asDiagonal();
    if (i == 0) {  // times the identity
      V.leftCols(n) += h_ * at_.a_q;
      V.middleCols(n, n) += h_ * at_.a_v;
    } else {
      const Eigen::MatrixXd before = at_.a_v * V;
      V += h_ * before;
      V += h_ * (at_.a_q * Q);
    }
    V.rightCols(n) += h_ * at_.a_u;
    Q += h_ * V;
    move(y);
  }
  MotionJacobians J{Eigen::MatrixXd(2 * n, 2 * n), Eigen::MatrixXd(2 * n, n)};
  J.A << Q.leftCols(2 * n), V.leftCols(2 * n);
  J.B << Q.rightCols(n), V.rightCols(n);
  return J;
}

}  // namespace rex
