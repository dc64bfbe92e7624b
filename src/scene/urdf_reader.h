#pragma once

#include "scene/scene_file.h"

namespace rex {

/// Reads a URDF robot, its meshes, and who may collide from an SRDF, as share/doc/urdf.md says. Throws Error
/// with file:line:column, what, found and wanted: file missing or over 8 MiB, XML, xacro, what is missing,
/// given twice, or no number of the right sign; joints that do not make a tree, or more than 1000; a free
/// base of the world itself; and as loadMeshes() and readSrdf(). What other readers live with is repaired,
/// with a warning, and only refused if `strict`.
[[nodiscard]] SceneFile readUrdf(const std::filesystem::path& file, const ReadOptions& options = {});

/// The same for text at hand; `name` stands for the file in messages. Reads no file: shapes know their mesh
/// by name only.
[[nodiscard]] SceneFile parseUrdf(std::string_view text, const std::string& name,
                                  const ReadOptions& options = {});

}  // namespace rex
