#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "scene/mesh_reader.h"

namespace rex::mesh {

/// The mesh of a file that keeps to the limits (requireSize(), requireHarmless()), as of readMesh(), read in
/// this process, which assimp may end; with `textures` as of readTexturedMesh(). Sees files of `folder` and
/// below; none if it is empty.
[[nodiscard]] TexturedMesh readByAssimp(std::string_view bytes, const std::string& name,
                                        const std::filesystem::path& folder, bool textures = false);

}  // namespace rex::mesh
