#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "exercise.h"

// The planar arm, and balls that are in its way. Used by show.cpp and by the grader.

/// A ball in the plane of the arm: its centre (y, z) and radius, metres.
struct Ball {
  double y = 0, z = 0, radius = 0;
};

inline rex::SimulatorDescription armAmong(const std::vector<Ball>& balls, const Eigen::VectorXd& q) {
  rex::SimulatorDescription scene = rex::Simulator("arm3.ors").description();
  for (const std::string link : {"arm1", "arm2", "eff"})
    scene.sceneText += "\nEdit body " + link + " { contact }";
  for (std::size_t i = 0; i < balls.size(); ++i)
    scene.sceneText += "\nshape ball" + std::to_string(i) + " { rel=<T t(0 " + std::to_string(balls[i].y) +
                       " " + std::to_string(balls[i].z) + ")> type=ST_sphere size=[0 0 0 " +
                       std::to_string(balls[i].radius) + "] color=[.25 .35 .60] contact }";
  scene.q = q;
  return scene;
}

/// A ball that the hand would hit on the direct way.
inline const std::vector<Ball> kBall{{-0.9, 1.05, 0.04}};
inline const Eigen::Vector3d kArmStart(0.8, 0.2, 0.2);
inline const Errand kErrand{
    .goal = Eigen::Vector3d(-0.8, 0.2, 0.2), .detour = Eigen::Vector3d(-0.7, 1.4, 0), .budget = 20.5};
