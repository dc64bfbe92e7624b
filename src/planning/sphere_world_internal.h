#pragma once

#include <vector>

#include "planning/sphere_kernel_internal.h"
#include "planning/sphere_robot.h"

namespace rex {

struct SphereRobot::Data {
  Eigen::VectorXd lower, upper;
  std::vector<internal::SphereLink> links;
  std::vector<internal::SphereNode> nodes;
  std::vector<internal::SphereGroup>
      groups;  ///< first those of whole links with spheres, then those of bodies
  std::vector<internal::SphereLinkPair> linkPairs;
  std::vector<internal::SpherePair> pairs;
  std::vector<float> reach, approach;
  /// Balls that the spheres of the first groups never leave, in blocks of eight: three rows of centres, one
  /// of radii.
  std::vector<float> balls;
  int guards = 0;           ///< groups of whole links that move
  double size = 0;          ///< how far its spheres get from the origin, metres
  double largestAngle = 0;  ///< radians
};

struct SphereWorld::Data {
  Data(const SphereRobot& one, const internal::SphereKernel& table) : robot(one), kernel(table) {}

  SphereRobot robot;
  internal::SphereKernel kernel;
  std::vector<internal::SphereObstacle> obstacles;
  std::vector<int> reachable;
  std::vector<internal::SphereGuard> guards;
  internal::SphereScene scene;
};

}  // namespace rex
