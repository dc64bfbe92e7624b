#pragma once

#include <map>
#include <string>

#include <kdl/tree.hpp>

#include "geometry/pose.h"

namespace rex {

/// A URDF robot as urdfdom reads it, without any code of ours: a tree of Orocos KDL, how its joints follow
/// one another, and the links that have a mass.
struct UrdfdomRobot {
  struct Follow {
    std::string target;  // the joint itself unless it mimics
    double multiplier = 1, offset = 0;
  };
  struct Inertial {
    double mass = 0;
    Pose X_BI;
    Eigen::Matrix3d I;  // in I
  };

  KDL::Tree tree;
  std::string root;
  std::map<std::string, Follow> joints;
  std::map<std::string, Inertial> inertials;
};

/// Throws std::runtime_error for joints that do not turn, slide or hold, and for what urdfdom refuses.
UrdfdomRobot urdfdomRobot(const std::string& text);

}  // namespace rex
