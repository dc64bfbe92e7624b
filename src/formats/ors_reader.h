#pragma once

#include "formats/scene_file.h"

namespace rex {

/// Reads an .ors scene, the files it includes, its URDF robots, and its meshes, as described in
/// share/doc/scenes.md. Throws Error with file:line:column, what, found and wanted for a file that is
/// missing or outside the asset root, syntax errors, unknown names, values of the wrong kind, exceeded
/// limits, and as readUrdf() and loadMeshes().
[[nodiscard]] SceneFile readOrs(const std::filesystem::path& file, const ReadOptions& options = {});

/// The same for text in memory; `name` stands for the file in messages. Reads no file, so shapes know their
/// mesh by name only, and an Include or urdf is an Error.
[[nodiscard]] SceneFile parseOrs(std::string_view text, const std::string& name,
                                 const ReadOptions& options = {});

}  // namespace rex
