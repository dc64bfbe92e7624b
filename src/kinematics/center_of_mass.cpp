#include "kinematics/center_of_mass.h"

#include <fmt/format.h>

#include "kinematics/jacobians.h"

namespace rex {
namespace {

void requireMass(const Model& model) {
  if (model.mass() > 0) return;
  throw Error({.what = fmt::format("centre of mass of scene '{}'", model.name()),
               .found = "no body with a mass",
               .wanted = "'mass=' on at least one body"});
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

Eigen::Matrix3Xd centerOfMassJacobian(const Model& model, const BodyPoses& poses) {
  requireMass(model);
  Eigen::Matrix3Xd sum = Eigen::Matrix3Xd::Zero(3, model.nv()), J(3, model.nv());
  for (std::size_t i = 0; i < model.bodies().size(); ++i) {
    const Body& body = model.bodies()[i];
    if (body.mass == 0) continue;
    positionJacobian(model, poses, BodyId{static_cast<int>(i)}, body.p_BBcm, J);
    sum += body.mass * J;
  }
  return sum / model.mass();
}

}  // namespace rex
