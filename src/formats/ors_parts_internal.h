#pragma once

#include <filesystem>
#include <string>

#include "formats/ors_attributes_internal.h"
#include "scene/scene_spec.h"

namespace rex::ors {

/// What a joint knows of the scene around it.
struct JointSurroundings {
  Pose X_WP, X_WC;                      ///< of the bodies it connects, as the file has them
  const JointSpec* followed = nullptr;  ///< the joint that its attribute 'mimic' names
};

/// Reads what the attributes say into a joint that has its name and its bodies. Throws Error at the
/// attribute that is wrong.
void readJoint(const Attributes& attributes, const JointSurroundings& around, JointSpec& joint,
               Diagnostics& notes);

/// The name of the joint that this one follows; empty: none.
[[nodiscard]] std::string readMimic(const Attributes& attributes);

/// Throws Error at the attribute that is wrong unless `joint` can follow `leader`, which its 'mimic' names.
void requireLeader(const Attributes& attributes, const JointSpec& joint, const JointSpec& leader);

/// How a robot becomes part of a scene.
struct RobotPlace {
  std::string prefix{};             ///< of the names of its bodies, joints and shapes
  std::string parent = kWorldName;  ///< the body that carries it, or the world
  Pose X_PR{};                      ///< of the robot's world in the parent
  std::filesystem::path folder{};   ///< of the scene, as seen from which its meshes are named
  int pairsBefore = 0;              ///< how many numbers of ContactMask::pairs are taken
};

/// The robot in its place. On a body its roots hang by rigid joints called "PARENT>ROOT"; what it has in the
/// world belongs to the parent then.
[[nodiscard]] SceneSpec placedRobot(SceneSpec robot, const RobotPlace& place);
/// One more than the largest number of ContactMask::pairs, at least `least`.
[[nodiscard]] int pairsIn(const SceneSpec& robot, int least);

/// The attributes that a shape has, and the ones it may have without effect.
[[nodiscard]] const std::vector<std::string>& shapeAttributes();

/// The shape that the attributes describe; they may also be those of a body. `where` is its statement.
[[nodiscard]] ShapeSpec readShape(const Attributes& attributes, std::string name, const Place& where,
                                  Diagnostics& notes);

}  // namespace rex::ors
