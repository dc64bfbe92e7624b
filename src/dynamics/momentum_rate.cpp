#include "dynamics/momentum_rate.h"

#include "base/error.h"
#include "dynamics/spatial_internal.h"

namespace rex {

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
