#include "dynamics/energy.h"

#include "base/error.h"
#include "dynamics/mass_matrix.h"
#include "kinematics/forward_kinematics.h"

namespace rex {

Energy energy(const Model& model, const VectorArg& q, const VectorArg& v, const Eigen::Vector3d& gravity_W) {
  requireSize("joint velocities v", v.size(), model.nv());
  Energy energy{.kinetic = 0.5 * v.dot(massMatrix(model, q) * v)};
  const BodyPoses poses = forwardKinematics(model, q);
  for (std::size_t i = 1; i < model.bodies().size(); ++i) {
    const Body& body = model.bodies()[i];
    energy.potential -= body.mass * gravity_W.dot(poses.X_WB[i] * body.p_BBcm);
  }
  return energy;
}

}  // namespace rex
