#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "base/diagnostic.h"
#include "scene/scene_spec.h"

namespace rex {

/// What a file holds, and what the reader noticed (ignored attributes, likely misspellings).
struct SceneFile {
  SceneSpec spec;
  Diagnostics notes;
};

/// Reads an .ors scene. Throws Error with file:line:column, what, found and wanted: file missing or over 32
/// MiB, syntax, unknown parent, wrong kind of value, bad sizes, a statement that is not read yet (Include,
/// Edit, ...); and as loadMeshes(), which it calls.
[[nodiscard]] SceneFile readOrs(const std::filesystem::path& path);

/// The text of a scene file. Throws Error if it is missing or over 32 MiB.
[[nodiscard]] std::string readSceneText(const std::filesystem::path& path);

/// The same as readOrs for text at hand; `name` stands for the file in messages. Reads no file: shapes know
/// their mesh by name only, see loadMeshes().
[[nodiscard]] SceneFile parseOrs(std::string_view text, const std::string& name);

}  // namespace rex
