#pragma once

#include "formats/scene_file.h"

namespace rex {

/// Reads a MuJoCo model (MJCF), the files it includes, and its meshes, as described in
/// share/doc/robot-files.md. Throws Error with file:line:column, what, found and wanted for files that are
/// missing, over 8 MiB or outside the asset root, XML faults, names that are unknown or given twice, invalid
/// sizes, directions or ranges, more than 1000 joints, the option freeBase (MJCF has <freejoint> instead),
/// and as loadMeshes(). Elements that are not read are noted, once for each kind.
[[nodiscard]] SceneFile readMjcf(const std::filesystem::path& file, const ReadOptions& options = {});

/// The same for text in memory; `name` stands for the file in messages. Reads no file, so an <include>, and
/// a mass that depends on a mesh, are Errors.
[[nodiscard]] SceneFile parseMjcf(std::string_view text, const std::string& name,
                                  const ReadOptions& options = {});

}  // namespace rex
