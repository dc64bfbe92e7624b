#pragma once

#include <filesystem>
#include <string>

#include "scene/scene_spec.h"

namespace rex::ors {

/// How a robot becomes part of a scene.
struct RobotPlace {
  std::string prefix{};             ///< of the names of its bodies, joints and shapes
  std::string parent = kWorldName;  ///< the body that carries it, or the world
  Pose X_PR{};                      ///< of the robot's world in the parent
  std::filesystem::path folder{};   ///< of the scene, as seen from which its meshes are named
};

/// The robot in its place. On a body its roots hang by rigid joints called "PARENT>ROOT"; what it has in the
/// world belongs to the parent then.
[[nodiscard]] SceneSpec placedRobot(SceneSpec robot, const RobotPlace& place);

}  // namespace rex::ors
