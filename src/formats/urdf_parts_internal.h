#pragma once

#include <string>
#include <unordered_map>
#include <vector>

#include "formats/scene_file.h"
#include "formats/urdf_tag_internal.h"

// The steps of reading a robot, in their order. All throw Error with the place.
namespace rex::urdf {

/// Refuses elements and attributes that xacro must work on before it is `format`, "URDF" or "SRDF".
void refuseXacro(const xml::Document& document, const std::string& format);

/// Warns of blanks before the declaration, which xml::parse() skipped.
void noteSkippedBlanks(Reading& reading);

/// What dynamics can work with of an inertia about the centre of mass, kg m^2, of a body of that mass:
/// negative principal moments become 0, with a warning or, if strict, an Error. `subject` begins the message.
[[nodiscard]] Eigen::Matrix3d judgedMoments(Reading& reading, const SourceLocation& where,
                                            const std::string& subject, const Eigen::Matrix3d& I,
                                            double mass);
/// The same for an inertia that a tag gives.
[[nodiscard]] inline Eigen::Matrix3d judgedMoments(const Tag& tag, const Eigen::Matrix3d& I, double mass) {
  return judgedMoments(tag.reading(), tag.where(), tag.subject(), I, mass);
}

/// A plane becomes a box under it of this thickness, metres, and where it is endless of this width.
inline constexpr double kPlaneThickness = 1, kPlaneWidth = 100;

/// The colours of materials by their name. A name belongs to the first material that gives it a colour, at
/// the top of the robot before those in links.
struct Materials {
  std::unordered_map<std::string, Eigen::Vector4d> colors;
  std::vector<std::string> guesses;  ///< some of the names, in the order of the file, for messages

  bool add(const std::string& name, const Eigen::Vector4d& color);  ///< whether the name is new
};
[[nodiscard]] Materials readMaterials(const Tag& robot);

/// A <link> with its shapes; meshes are known by name only.
[[nodiscard]] BodySpec readLink(const Tag& tag, const Materials& materials);

/// A <joint>, and where it names other things.
struct ReadJoint {
  JointSpec spec;
  SourceLocation parentAt, childAt, mimicAt;
};
[[nodiscard]] ReadJoint readJoint(const Tag& tag);

/// Refuses whatever is not one tree: unknown or repeated names, loops, several roots; and mimics of joints
/// that cannot be followed. A mimic of a joint that is not there is left out, with a warning or, if the
/// reading is strict, an Error. Returns the index of the root.
[[nodiscard]] std::size_t requireTree(const std::vector<BodySpec>& links, std::vector<ReadJoint>& joints,
                                      const SourceLocation& robot, Reading& reading);

/// Leaves out the limits of each joint that mimics if they let the joint that it follows be nowhere or only
/// at one point; all mimics are known to be sound. Throws Error instead if the reading is strict.
void keepTargetsMovable(std::vector<ReadJoint>& joints, Reading& reading);

}  // namespace rex::urdf
