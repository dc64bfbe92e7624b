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

using internal::MassInWorld;

MomentumRate momentumRate(const Model& model, const BodyPoses& poses, const VectorArg& v,
                          const VectorArg& a) {
  requireSize("joint velocities v", v.size(), model.nv());
  requireSize("joint accelerations a", a.size(), model.nv());
  const std::vector<Vector6d> V = internal::bodyTwists(model, poses, v);
  std::vector<Vector6d> A(V.size(), Vector6d::Zero());  // how fast the twists change
  MomentumRate rate{Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};
  for (std::size_t i = 1; i < V.size(); ++i) {
    const BodyId id{static_cast<int>(i)};
    A[i] = A[static_cast<std::size_t>(model[id].parent)];
    internal::forEachFreedomOf(
        model, id, [&](int column, const Joint& joint, const DegreeOfFreedom& freedom) {
          const Vector6d s = internal::freedomTwist(joint, freedom, poses);
          A[i] += a[column] * s + v[column] * internal::freedomTwistRate(joint, freedom, s, V);
        });
    const MassInWorld body(model[id], poses[id]);
    const Eigen::Vector3d w = V[i].tail<3>(), turn = A[i].tail<3>();
    // The twist holds the velocity of the point that passes the origin, a different one at each time.
    const Eigen::Vector3d acceleration = A[i].head<3>() + turn.cross(body.p) + w.cross(body.velocity(V[i]));
    rate.force += body.mass * acceleration;
    rate.torque += body.p.cross(body.mass * acceleration) + body.I * turn + w.cross(body.I * w);
  }
  return rate;
}

}  // namespace rex
