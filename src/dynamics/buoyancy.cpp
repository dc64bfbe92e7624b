#include <vector>

#include "dynamics/buoyancy_internal.h"
#include "dynamics/spatial_internal.h"

namespace rex::internal {

void addBuoyancy(const Model& model, const VectorArg& q, const Eigen::Vector3d& gravity_W, double sign,
                 DynamicsWorkspace& workspace, Eigen::Ref<Eigen::VectorXd> u) {
  if (!model.hasBuoyancy()) return;
  forwardKinematics(model, q, workspace.poses);
  std::vector<Vector6d>& force = workspace.perBody;  // on a body and all it carries
  force.assign(model.bodies().size(), Vector6d::Zero());
  for (std::size_t i = force.size(); i-- > 1;) {
    const Body& body = model.bodies()[i];
    const Eigen::Vector3d lift = -sign * body.buoyancy * body.mass * gravity_W;
    force[i] += forceAt(workspace.poses.X_WB[i] * body.p_BBcm, lift);
    force[static_cast<std::size_t>(body.parent)] += force[i];
    forEachFreedomOf(model, BodyId{static_cast<int>(i)},
                     [&](int column, const Joint& joint, const DegreeOfFreedom& freedom) {
                       u[column] += freedomTwist(joint, freedom, workspace.poses).dot(force[i]);
                     });
  }
}

namespace {

// What is carried of a body and all that hangs on it, in W: a mass, and the mass times its centre.
struct Carried {
  double mass = 0;
  Eigen::Vector3d moment{0, 0, 0};
};

struct Freedom {
  int column = 0;
  BodyId body = kWorld;
  Vector6d s{};
  bool turnsAlong = false;  // with the other freedoms of its joint
};

// From the body's own freedoms up to the world.
std::vector<Freedom> freedomsAbove(const Model& model, const BodyPoses& poses, BodyId body) {
  std::vector<Freedom> all;
  for (BodyId at = body; at != kWorld; at = model[at].parent)
    forEachFreedomOf(model, at, [&](int column, const Joint& joint, const DegreeOfFreedom& freedom) {
      all.push_back(
          {column, at, freedomTwist(joint, freedom, poses), freedom.frame == DegreeOfFreedom::Frame::kChild});
    });
  return all;
}

}  // namespace

// The force of a freedom is s . f. A freedom above turns s and moves what is carried, one below only moves
// its own part of that, and f keeps its direction.
void subtractBuoyancyDerivative(const Model& model, const VectorArg& q, const Eigen::Vector3d& gravity_W,
                                Eigen::MatrixXd& u_q) {
  if (!model.hasBuoyancy()) return;
  const BodyPoses poses = forwardKinematics(model, q);
  std::vector<Carried> carried(model.bodies().size());
  for (std::size_t i = carried.size(); i-- > 1;) {
    const Body& body = model.bodies()[i];
    Carried& one = carried[i];
    one.mass += body.buoyancy * body.mass;
    one.moment += body.buoyancy * body.mass * (poses.X_WB[i] * body.p_BBcm);
    Carried& parent = carried[static_cast<std::size_t>(body.parent)];
    parent.mass += one.mass;
    parent.moment += one.moment;
    const Vector6d force = spatial(-one.mass * gravity_W, -one.moment.cross(gravity_W));
    // What the force changes by, if all that is carried moves along s.
    const auto change = [&](const Vector6d& s) {
      const Eigen::Vector3d moved = one.mass * s.head<3>() + s.tail<3>().cross(one.moment);
      return spatial(Eigen::Vector3d::Zero(), -moved.cross(gravity_W));
    };
    const BodyId id{static_cast<int>(i)};
    const std::vector<Freedom> above = freedomsAbove(model, poses, id);
    for (const Freedom& own : above) {
      if (own.body != id) break;
      for (const Freedom& other : above) {
        const bool turns = other.body != id || own.turnsAlong;
        u_q(own.column, other.column) -= own.s.dot(change(other.s));
        if (turns) u_q(own.column, other.column) -= crossMotion(other.s, own.s).dot(force);
        if (other.body != id) u_q(other.column, own.column) -= other.s.dot(change(own.s));
      }
    }
  }
}

}  // namespace rex::internal
