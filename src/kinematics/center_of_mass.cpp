#include "kinematics/center_of_mass.h"

#include <cassert>

#include <Eigen/Geometry>
#include <fmt/format.h>

namespace rex {
namespace {

void requireMass(const Model& model) {
  if (model.mass() > 0) return;
  throw Error({.what = fmt::format("centre of mass of scene '{}'", model.name()),
               .found = "no body with a mass",
               .wanted = "'mass=' on at least one body"});
}

// Children come after their parents, so one backward pass sums up every subtree.
void addMoments(const Model& model, const BodyPoses& poses, Eigen::Matrix3Xd& moments) {
  const int n = static_cast<int>(model.bodies().size());
  moments.setZero(3, n);
  for (int i = n - 1; i > 0; --i) {
    const BodyId id{i};
    const Body& body = model[id];
    moments.col(i) += body.mass * (poses[id] * body.p_BBcm);
    moments.col(static_cast<int>(body.parent)) += moments.col(i);
  }
}

}  // namespace

Eigen::Vector3d centerOfMass(const Model& model, const BodyPoses& poses) {
  requireMass(model);
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < model.bodies().size(); ++i) {
    const Body& body = model.bodies()[i];
    sum += body.mass * (poses.X_WB[i] * body.p_BBcm);
  }
  return sum / model.mass();
}

void centerOfMassJacobian(const Model& model, const BodyPoses& poses, Eigen::Matrix3Xd& moments,
                          Eigen::Ref<Eigen::Matrix3Xd> J) {
  requireMass(model);
  assert(J.cols() == model.nv());
  addMoments(model, poses, moments);
  J.setZero();
  for (const Joint& joint : model.joints()) {
    const double share = model[joint.child].subtreeMass / model.mass();
    const Eigen::Vector3d moment = moments.col(static_cast<int>(joint.child)) / model.mass();
    for (int i = 0; i < joint.nv; ++i) {
      const DegreeOfFreedom& freedom = joint.freedoms[static_cast<std::size_t>(i)];
      const bool inParent = freedom.frame == DegreeOfFreedom::Frame::kParent;
      const Pose& X = poses[inParent ? joint.parent : joint.child];
      const Eigen::Vector3d axis = X.R * freedom.angular;
      // += because joints that mimic one another share a column.
      J.col(joint.vIndex + i) += axis.cross(moment - share * X.p) + share * (X.R * freedom.linear);
    }
  }
}

Eigen::Matrix3Xd centerOfMassJacobian(const Model& model, const BodyPoses& poses) {
  Eigen::Matrix3Xd moments, J(3, model.nv());
  centerOfMassJacobian(model, poses, moments, J);
  return J;
}

}  // namespace rex
