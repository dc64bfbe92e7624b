#pragma once

#include "formats/scene_file.h"

namespace rex {

/// Reads a URDF robot, its meshes, and the collision choices of an SRDF, as described in
/// share/doc/robot-files.md. Throws Error with file:line:column, what, found and wanted for a file that is
/// missing or over 8 MiB, XML faults, xacro, items that are missing, given twice, or not a number of the
/// right sign, joints that do not form a tree, more than 1000 joints, a free base of the world itself, and as
/// loadMeshes() and readSrdf(). Faults that other readers accept are repaired with a warning, and refused
/// only if `strict`.
[[nodiscard]] SceneFile readUrdf(const std::filesystem::path& file, const ReadOptions& options = {});

/// The same for text in memory; `name` stands for the file in messages. Reads no file, so shapes know their
/// mesh by name only.
[[nodiscard]] SceneFile parseUrdf(std::string_view text, const std::string& name,
                                  const ReadOptions& options = {});

}  // namespace rex
