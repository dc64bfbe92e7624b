#include "dynamics/centroidal.h"

#include "base/error.h"
#include "dynamics/spatial_internal.h"
#include "geometry/rotation.h"
#include "kinematics/center_of_mass.h"

namespace rex {

using internal::MassInWorld;

Centroidal centroidal(const Model& model, const BodyPoses& poses, const VectorArg& v) {
  requireSize("joint velocities v", v.size(), model.nv());
  const std::vector<Vector6d> V = internal::bodyTwists(model, poses, v);
  const Eigen::Vector3d zero = Eigen::Vector3d::Zero();
  Centroidal all{centerOfMass(model, poses), zero, zero, zero, Eigen::Matrix3d::Zero()};
  for (std::size_t i = 0; i < V.size(); ++i) {
    const MassInWorld body(model.bodies()[i], poses.X_WB[i]);
    const Eigen::Vector3d momentum = body.mass * body.velocity(V[i]), arm = body.p - all.center;
    all.linearMomentum += momentum;
    all.angularMomentum += body.I * V[i].tail<3>() + arm.cross(momentum);
    all.inertia += body.I - body.mass * skew(arm) * skew(arm);
  }
  all.velocity = all.linearMomentum / model.mass();
  return all;
}

Eigen::Matrix<double, 6, Eigen::Dynamic> centroidalMomentumMatrix(const Model& model,
                                                                  const BodyPoses& poses) {
  const Eigen::Vector3d center = centerOfMass(model, poses);
  // Inertia of a body and everything it carries, about the origin.
  std::vector<internal::Matrix6d> inertia(poses.X_WB.size(), internal::Matrix6d::Zero());
  Eigen::Matrix<double, 6, Eigen::Dynamic> A(6, model.nv());
  A.setZero();
  for (int i = static_cast<int>(inertia.size()) - 1; i > 0; --i) {
    const BodyId id{i};
    internal::Matrix6d& I = inertia[static_cast<std::size_t>(i)];
    I += MassInWorld(model[id], poses[id]).spatialInertia();
    inertia[static_cast<std::size_t>(model[id].parent)] += I;
    const auto add = [&](int column, const Joint& joint, const DegreeOfFreedom& freedom) {
      A.col(column) += I * internal::freedomTwist(joint, freedom, poses);
    };
    internal::forEachFreedomOf(model, id, add);
  }
  A.bottomRows<3>() -= skew(center) * A.topRows<3>();
  return A;
}

}  // namespace rex
