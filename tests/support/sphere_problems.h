#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "collision/collision_pairs.h"
#include "formats/scene_file.h"

namespace rex {

/// A motion planning problem of an arm: obstacles stand in the frame of its base.
struct SphereProblem {
  std::string set, name;
  Eigen::VectorXd start, goal;
  std::vector<ShapeSpec> obstacles;
};

/// The .json files of a folder, in the order of their names. Throws Error for a folder without any.
[[nodiscard]] std::vector<std::filesystem::path> sphereProblemFiles(const std::filesystem::path& folder);

/// The problems of all .json files of a folder, in the order of their names, for a robot of so many
/// coordinates. A file is {"set", "problems": [{"name", "start", "goal", "objects": [{"id", "type",
/// "position", "quat_wxyz"}]}]}; boxes have a "size", spheres a "radius", cylinders and capsules a "radius"
/// and a straight "height". Throws Error that names the file for whatever is missing or wrong, and for a
/// folder without such files.
[[nodiscard]] std::vector<SphereProblem> readSphereProblems(const std::filesystem::path& folder,
                                                            int coordinates);

/// A URDF robot of spheres without its pictures. Throws like readScene(), and for a shape in contact that is
/// a mesh or fixed to the world itself.
[[nodiscard]] SceneSpec readSphereRobot(const std::filesystem::path& urdf,
                                        const std::filesystem::path& srdf = {});

/// Judges motions of a robot among obstacles by the exact distances of src/collision.
class ExactJudge {
 public:
  /// The pairs of the robot that may collide, and all pairs of an obstacle and a shape that moves.
  ExactJudge(const SceneSpec& robot, const std::vector<ShapeSpec>& obstacles);

  /// Empty if the posture is free and within the limits, otherwise what is wrong.
  [[nodiscard]] std::string faultOf(const VectorArg& q) const;
  /// Empty if the path leads from start to goal, stays within the limits, and is proven free, also between
  /// its postures, otherwise what is wrong.
  [[nodiscard]] std::string faultOf(const MatrixArg& path, const VectorArg& start,
                                    const VectorArg& goal) const;

  [[nodiscard]] const Model& model() const { return model_; }
  [[nodiscard]] const ContactModel& contacts() const { return contacts_; }

 private:
  Model model_;
  ContactModel contacts_;
};

}  // namespace rex
