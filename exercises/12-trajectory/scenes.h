#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "exercise.h"

// The planar arm, and balls that are in its way. Used by main() and by the grader.

/// A ball in the plane of the arm: its centre (y, z) and radius, metres.
struct Ball {
  double y = 0, z = 0, radius = 0;
};

inline rex::SimulatorDescription armAmong(const std::vector<Ball>& balls, const Eigen::VectorXd& q) {
  rex::SimulatorDescription scene = rex::Simulator("arm3.ors").description();
  for (const char* link : {"arm1", "arm2", "eff"})
    scene.sceneText += fmt::format("\nEdit body {} {{ contact }}", link);
  for (std::size_t i = 0; i < balls.size(); ++i)
    scene.sceneText += fmt::format(
        "\nshape ball{} {{ rel=<T t(0 {} {})> type=ST_sphere size=[0 0 0 {}] color=[.25 .35 .60] contact }}",
        i, balls[i].y, balls[i].z, balls[i].radius);
  scene.q = q;
  return scene;
}

/// A ball that the hand would hit on the direct way.
inline const std::vector<Ball> kBall{{-0.9, 1.05, 0.04}};
inline const Eigen::Vector3d kArmStart(0.8, 0.2, 0.2);
inline const Errand kErrand{
    .goal = Eigen::Vector3d(-0.8, 0.2, 0.2), .detour = Eigen::Vector3d(-0.7, 1.4, 0), .budget = 20.5};
