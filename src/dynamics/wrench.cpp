#include "dynamics/wrench.h"

#include <cassert>

#include "dynamics/spatial_internal.h"

namespace rex {

Eigen::VectorXd wrenchForces(const Model& model, const BodyPoses& poses, std::span<const Wrench> wrenches) {
  assert(poses.X_WB.size() == model.bodies().size());
  std::vector<Vector6d> force(poses.X_WB.size(), Vector6d::Zero());
  for (const Wrench& wrench : wrenches) {
    Vector6d& f = force[static_cast<std::size_t>(wrench.body)];
    f += internal::forceAt(poses[wrench.body] * wrench.p_BQ, wrench.force_W);
    f.tail<3>() += wrench.torque_W;
  }
  Eigen::VectorXd u = Eigen::VectorXd::Zero(model.nv());
  for (int i = static_cast<int>(force.size()) - 1; i > 0; --i) {
    const Vector6d& f = force[static_cast<std::size_t>(i)];
    force[static_cast<std::size_t>(model[BodyId{i}].parent)] += f;
    const auto add = [&](int column, const Joint& joint, const DegreeOfFreedom& freedom) {
      u[column] += internal::freedomTwist(joint, freedom, poses).dot(f);
    };
    internal::forEachFreedomOf(model, BodyId{i}, add);
  }
  return u;
}

}  // namespace rex
