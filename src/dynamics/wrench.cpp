#include "dynamics/wrench.h"

#include <cassert>

#include <fmt/format.h>

#include "base/error.h"
#include "dynamics/spatial_internal.h"

namespace rex {

void wrenchForces(const Model& model, const BodyPoses& poses, std::span<const Wrench> wrenches,
                  DynamicsWorkspace& workspace, Eigen::Ref<Eigen::VectorXd> u) {
  assert(poses.X_WB.size() == model.bodies().size());
  requireSize("joint forces u", u.size(), model.nv());
  std::vector<Vector6d>& force = workspace.perBody;
  force.assign(poses.X_WB.size(), Vector6d::Zero());
  for (const Wrench& wrench : wrenches) {
    Vector6d& f = force[static_cast<std::size_t>(wrench.body)];
    f += internal::forceAt(poses[wrench.body] * wrench.p_BQ, wrench.force_W);
    f.tail<3>() += wrench.torque_W;
  }
  u.setZero();
  for (int i = static_cast<int>(force.size()) - 1; i > 0; --i) {
    const Vector6d& f = force[static_cast<std::size_t>(i)];
    force[static_cast<std::size_t>(model[BodyId{i}].parent)] += f;
    const auto add = [&](int column, const Joint& joint, const DegreeOfFreedom& freedom) {
      u[column] += internal::freedomTwist(joint, freedom, poses).dot(f);
    };
    internal::forEachFreedomOf(model, BodyId{i}, add);
  }
}

Eigen::VectorXd wrenchForces(const Model& model, const BodyPoses& poses, std::span<const Wrench> wrenches) {
  DynamicsWorkspace workspace;
  Eigen::VectorXd u(model.nv());
  wrenchForces(model, poses, wrenches, workspace, u);
  return u;
}

void requireValid(const Model& model, std::span<const Wrench> wrenches) {
  const int bodies = static_cast<int>(model.bodies().size());
  for (const Wrench& wrench : wrenches) {
    const int body = static_cast<int>(wrench.body);
    if (body < 0 || body >= bodies) {
      throw Error({.what = "body of a wrench",
                   .found = fmt::format("number {}", body),
                   .wanted = fmt::format("one of the {} bodies of the model", bodies)});
    }
    if (!wrench.p_BQ.allFinite() || !wrench.force_W.allFinite() || !wrench.torque_W.allFinite()) {
      throw Error({.what = fmt::format("wrench on body '{}'", model[wrench.body].name),
                   .found = "a number that is not finite",
                   .wanted = "a finite point, force and torque"});
    }
  }
}

}  // namespace rex
