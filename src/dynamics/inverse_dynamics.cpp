#include "dynamics/inverse_dynamics.h"

#include <cassert>

#include <fmt/format.h>

#include "base/cpu_lanes.h"
#include "base/derivative_check.h"
#include "base/error.h"
#include "base/require.h"
#include "dynamics/buoyancy_internal.h"
#include "dynamics/kernel_room_internal.h"
#include "dynamics/kernels_internal.h"
#include "dynamics/requirements_internal.h"
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

void inverseDynamics(const Model& model, const VectorArg& q, const VectorArg& v, const VectorArg& a,
                     const Eigen::Vector3d& gravity_W, DynamicsWorkspace& workspace,
                     Eigen::Ref<Eigen::VectorXd> u) {
  internal::requirePositions(model, q);
  internal::requireVelocities(model, v);
  requireSize("joint accelerations a", a.size(), model.nv());
  requireSize("joint forces u", u.size(), model.nv());
  const auto kernel = kernelFor<internal::InverseDynamicsKernel>(cpuLanes());
  const double *positions = q.data(), *velocities = v.data(), *accelerations = a.data();
  double* forces = u.data();
  kernel.one({.links = model.links().data(),
              .linkCount = static_cast<int>(model.links().size()),
              .nv = model.nv(),
              .gravity_W = gravity_W.data(),
              .q = &positions,
              .v = &velocities,
              .given = &accelerations,
              .result = &forces,
              .memory = internal::roomFor(kernel, model, 1, workspace)});
  internal::addBuoyancy(model, q, gravity_W, -1, workspace, u);
}

Eigen::VectorXd inverseDynamics(const Model& model, const VectorArg& q, const VectorArg& v,
                                const VectorArg& a, const Eigen::Vector3d& gravity_W) {
  DynamicsWorkspace workspace;
  Eigen::VectorXd u(model.nv());
  inverseDynamics(model, q, v, a, gravity_W, workspace, u);
  return u;
}

void biasForces(const Model& model, const VectorArg& q, const VectorArg& v, const Eigen::Vector3d& gravity_W,
                DynamicsWorkspace& workspace, Eigen::Ref<Eigen::VectorXd> F) {
  workspace.zeros.setZero(model.nv());
  inverseDynamics(model, q, v, workspace.zeros, gravity_W, workspace, F);
}

Eigen::VectorXd biasForces(const Model& model, const VectorArg& q, const VectorArg& v,
                           const Eigen::Vector3d& gravity_W) {
  DynamicsWorkspace workspace;
  Eigen::VectorXd F(model.nv());
  biasForces(model, q, v, gravity_W, workspace, F);
  return F;
}

void gravityForces(const Model& model, const VectorArg& q, const Eigen::Vector3d& gravity_W,
                   DynamicsWorkspace& workspace, Eigen::Ref<Eigen::VectorXd> G) {
  workspace.zeros.setZero(model.nv());
  inverseDynamics(model, q, workspace.zeros, workspace.zeros, gravity_W, workspace, G);
}

Eigen::VectorXd gravityForces(const Model& model, const VectorArg& q, const Eigen::Vector3d& gravity_W) {
  DynamicsWorkspace workspace;
  Eigen::VectorXd G(model.nv());
  gravityForces(model, q, gravity_W, workspace, G);
  return G;
}

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
