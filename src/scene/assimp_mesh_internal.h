#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "geometry/triangle_mesh.h"

namespace rex::mesh {

/// The mesh of a file that keeps to the limits (requireSize(), requireHarmless()), as of readMesh(), read in
/// this process, which assimp may end. Sees files of `folder` and below; of none if it is empty.
[[nodiscard]] TriangleMesh readByAssimp(std::string_view bytes, const std::string& name,
                                        const std::filesystem::path& folder);

}  // namespace rex::mesh
