#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "formats/scene_file.h"
#include "scene/scene_spec.h"

namespace rex {

/// Adds the collision choices of an SRDF to a URDF robot: <disable_collisions>, <enable_collisions> and
/// <disable_default_collisions>, see share/doc/robot-files.md, and the postures that it names:
/// <group_state>. Warns of links and joints that the robot does not have and of pairs that are given twice;
/// one note lists what else the file holds. Throws Error with
/// file:line:column for a file that is missing or over 8 MiB, XML faults, xacro, a URDF in its place, a
/// missing link name, and a link paired with itself.
void readSrdf(const std::filesystem::path& file, SceneFile& robot);

/// The same for text in memory; `name` stands for the file in messages.
void parseSrdf(std::string_view text, const std::string& name, SceneFile& robot);

/// An SRDF with the collision choices of the robot of that name, as parseSrdf() reads it. A non-empty
/// `about` becomes a comment below its head. Throws Error for a name with characters that are not allowed
/// in XML.
[[nodiscard]] std::string writeSrdf(const std::string& robot, std::span<const CollisionChoice> choices,
                                    const std::string& about = "");

}  // namespace rex
