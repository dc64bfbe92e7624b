#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "scene/scene_file.h"

namespace rex {

/// Adds to a URDF robot what an SRDF says about who may collide: <disable_collisions>, <enable_collisions>
/// and <disable_default_collisions>, see share/doc/urdf.md. Warns of links that the robot lacks and of pairs
/// that are given twice; one note lists what else the file holds. Throws Error with file:line:column: file
/// missing or over 8 MiB, XML, xacro, a URDF in its place, a link that is not named, a link with itself.
void readSrdf(const std::filesystem::path& file, SceneFile& robot);

/// The same for text at hand; `name` stands for the file in messages.
void parseSrdf(std::string_view text, const std::string& name, SceneFile& robot);

}  // namespace rex
