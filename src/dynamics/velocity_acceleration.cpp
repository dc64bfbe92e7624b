#include "dynamics/velocity_acceleration.h"

#include "base/derivative_check.h"
#include "base/require.h"

namespace rex {

Eigen::VectorXd velocityAcceleration(const Model& model, const State& state, const TaskMap& map) {
  requireSize("joint velocities v", state.v.size(), model.nv());
  requireFinite("joint positions q", state.q);
  requireFinite("joint velocities v", state.v);
  Eigen::VectorXd q(model.nq());
  BodyPoses poses;
  TaskValue value;
  const double speed = state.v.size() > 0 ? state.v.cwiseAbs().maxCoeff() : 0;
  const Eigen::VectorXd direction = speed > 0 ? Eigen::VectorXd(state.v / speed) : state.v;
  const auto velocityAt = [&](const Eigen::VectorXd& way) {
    q = integrate(model, state.q, way[0] * direction);
    forwardKinematics(model, q, poses);
    map({model, q, poses}, value);
    return Eigen::VectorXd(value.J * direction);
  };
  return speed * speed * numericJacobian(velocityAt, Eigen::VectorXd::Zero(1));
}

}  // namespace rex
