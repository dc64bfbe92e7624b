#pragma once

#include <cmath>
#include <string>

#include "kinematics/closed_loops.h"
#include "scene/scene_spec.h"

namespace rex {

/// A crank, a coupler and a rocker in the plane y = 0, on the world by hinges about -y at x = 0 and at x =
/// ground; angles turn upwards. The crank turns all the way round.
struct FourBar {
  double ground = 1, crank = 0.3, coupler = 0.9, rocker = 0.7;  // metres

  [[nodiscard]] SceneSpec scene() const {
    SceneSpec spec{.name = "four-bar", .bodies = {}, .joints = {}, .worldShapes = {}};
    const auto add = [&](const std::string& name, const std::string& parent, double at, double length) {
      BodySpec link{.name = name, .X_WB = {}, .mass = 2 * length};
      link.p_BBcm = {length / 2, 0, 0};
      link.inertia = Eigen::Vector3d(1e-3, length * length / 6, length * length / 6).asDiagonal();
      JointSpec joint{.name = name + "-hinge", .parent = parent, .child = name, .X_PF = {}, .X_MC = {}};
      joint.axis = -Eigen::Vector3d::UnitY();
      joint.X_PF.p = {at, 0, 0};
      spec.bodies.push_back(link);
      spec.joints.push_back(joint);
    };
    add("crank", "world", 0, crank);
    add("rocker", "world", ground, rocker);
    add("coupler", "crank", crank, coupler);
    spec.pins.push_back({.a = "coupler", .b = "rocker", .p_AP = {coupler, 0, 0}, .p_BQ = {rocker, 0, 0}});
    return spec;
  }

  /// (angles of crank, rocker, coupler against the crank) where two circles meet, the coupler's end above.
  [[nodiscard]] Eigen::Vector3d closedForm(double angle) const {
    const Eigen::Vector2d A(crank * std::cos(angle), crank * std::sin(angle)), D(ground, 0), way = D - A;
    const double f = way.norm(),
                 gamma = std::acos((coupler * coupler + f * f - rocker * rocker) / (2 * coupler * f)),
                 direction = std::atan2(way.y(), way.x()) + gamma;
    const Eigen::Vector2d C = A + coupler * Eigen::Vector2d(std::cos(direction), std::sin(direction));
    return {angle, std::atan2(C.y() - D.y(), C.x() - D.x()), std::remainder(direction - angle, 2 * M_PI)};
  }
};

}  // namespace rex
