#pragma once

#include "scene/scene_file.h"

namespace rex {

/// Reads an .ors scene, the files it includes, its robots of URDF, and its meshes, as share/doc/ors-format.md
/// says. Throws Error with file:line:column, what, found and wanted: a file that is missing or outside the
/// asset root, syntax, unknown names, wrong kinds of values, more than the limits allow; and as readUrdf()
/// and loadMeshes().
[[nodiscard]] SceneFile readOrs(const std::filesystem::path& file, const ReadOptions& options = {});

/// The same for text at hand; `name` stands for the file in messages. Reads no file: shapes know their mesh
/// by name only, and an Include or urdf is an Error.
[[nodiscard]] SceneFile parseOrs(std::string_view text, const std::string& name,
                                 const ReadOptions& options = {});

}  // namespace rex
