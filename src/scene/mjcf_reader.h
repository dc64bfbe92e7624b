#pragma once

#include "scene/scene_file.h"

namespace rex {

/// Reads a MuJoCo model (MJCF), the files it includes, and its meshes, as share/doc/mjcf.md says. Throws
/// Error with file:line:column, what, found and wanted: files missing, over 8 MiB or outside the asset root,
/// XML, names that are unknown or given twice, numbers that are no sizes, directions or ranges, more than
/// 1000 joints; a free base, which a <freejoint> says; and as loadMeshes(). What is not
/// read is noted, once for each kind.
[[nodiscard]] SceneFile readMjcf(const std::filesystem::path& file, const ReadOptions& options = {});

/// The same for text at hand; `name` stands for the file in messages. Reads no file, so an <include>, and a
/// mass that only a mesh can tell, are Errors.
[[nodiscard]] SceneFile parseMjcf(std::string_view text, const std::string& name,
                                  const ReadOptions& options = {});

}  // namespace rex
