#pragma once

#include "scene/scene_file.h"

namespace rex {

/// Reads an .ors scene and its meshes. Throws Error with file:line:column, what, found and wanted: file
/// missing or over 32 MiB, syntax, unknown parent, wrong kind of value, bad sizes; and as loadMeshes().
[[nodiscard]] SceneFile readOrs(const std::filesystem::path& file, const ReadOptions& options = {});

/// The same for text at hand; `name` stands for the file in messages. Reads no file: shapes know their mesh
/// by name only.
[[nodiscard]] SceneFile parseOrs(std::string_view text, const std::string& name);

}  // namespace rex
