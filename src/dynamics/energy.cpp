#include "dynamics/energy.h"

#include "base/error.h"
#include "dynamics/joint_springs.h"
#include "dynamics/spatial_internal.h"
#include "scene/state.h"

namespace rex {

using internal::MassInWorld;

Energy energy(const Model& model, const VectorArg& q, const VectorArg& v, const Eigen::Vector3d& gravity_W,
              DynamicsWorkspace& workspace) {
  requireSize("joint velocities v", v.size(), model.nv());
  forwardKinematics(model, q, workspace.poses);
  internal::bodyTwists(model, workspace.poses, v, workspace.perBody);
  const std::vector<Vector6d>& V = workspace.perBody;
  Energy energy;
  for (std::size_t i = 0; i < V.size(); ++i) {
    const MassInWorld body(model.bodies()[i], workspace.poses.X_WB[i]);
    const Eigen::Vector3d w = V[i].tail<3>();
    energy.kinetic += 0.5 * (body.mass * body.velocity(V[i]).squaredNorm() + w.dot(body.I * w));
    energy.potential -= body.mass * (1 - model.bodies()[i].buoyancy) * gravity_W.dot(body.p);
  }
  energy.kinetic += 0.5 * v.dot(model.armature().cwiseProduct(v));
  energy.potential += springEnergy(model, q);
  return energy;
}

Energy energy(const Model& model, const VectorArg& q, const VectorArg& v, const Eigen::Vector3d& gravity_W) {
  DynamicsWorkspace workspace;
  return energy(model, q, v, gravity_W, workspace);
}

EnergyGradient energyGradient(const Model& model, const VectorArg& q, const VectorArg& v,
                              const Eigen::Vector3d& gravity_W) {
  requireSize("joint velocities v", v.size(), model.nv());
  const BodyPoses poses = forwardKinematics(model, q);
  const std::vector<Vector6d> V = internal::bodyTwists(model, poses, v);
  // Of a body and everything it carries.
  std::vector<Vector6d> momentum(V.size(), Vector6d::Zero()), weight(V.size(), Vector6d::Zero());
  EnergyGradient gradient{Eigen::VectorXd::Zero(model.nv()), Eigen::VectorXd::Zero(model.nv())};
  for (int i = static_cast<int>(V.size()) - 1; i > 0; --i) {
    const std::size_t at = static_cast<std::size_t>(i);
    const std::size_t parent = static_cast<std::size_t>(model[BodyId{i}].parent);
    const MassInWorld body(model[BodyId{i}], poses[BodyId{i}]);
    const double share = 1 - model[BodyId{i}].buoyancy;
    momentum[at] += body.momentum(V[at]);
    weight[at] += internal::forceAt(body.p, share * body.mass * gravity_W);
    momentum[parent] += momentum[at], weight[parent] += weight[at];
    // dT/dq = C^T v, in which each body adds its momentum along the rates of the twists above it.
    const auto add = [&](int column, const Joint& joint, const DegreeOfFreedom& freedom) {
      const Vector6d s = internal::freedomTwist(joint, freedom, poses);
      const Vector6d rate = internal::freedomTwistRate(joint, freedom, s, V);
      gradient.byPosition[column] += rate.dot(momentum[at]) - s.dot(weight[at]);
      gradient.byVelocity[column] += s.dot(momentum[at]);
    };
    internal::forEachFreedomOf(model, BodyId{i}, add);
  }
  gradient.byPosition -= springForces(model, q);
  gradient.byVelocity += model.armature().cwiseProduct(v);
  // For a quaternion, v is not the rate of the coordinates but turns with the body: hence Euler's w x p.
  forEachQuaternion(model, [&](int, int iv) {
    const Eigen::Vector3d w = v.segment<3>(iv), p = gradient.byVelocity.segment<3>(iv);
    gradient.byPosition.segment<3>(iv) += w.cross(p);
  });
  return gradient;
}

}  // namespace rex
