#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "base/isolated_call.h"
#include "formats/mesh_reader.h"

namespace rex::mesh {

/// The mesh of a file that keeps to the limits (requireSize(), requireHarmless()), as of readMesh(), read in
/// this process, which assimp may end; with `textures` as of readTexturedMesh(). Sees files of `folder` and
/// below; none if it is empty.
[[nodiscard]] TexturedMesh readByAssimp(std::string_view bytes, const std::string& name,
                                        const std::filesystem::path& folder, bool textures = false);

/// The same as readByAssimp() in a process of its own, so that no file harms this one. Throws Error, too, for
/// a file on which assimp crashes, takes longer or needs more memory than the limits.
[[nodiscard]] TexturedMesh readIsolated(std::string_view bytes, const std::string& name,
                                        const std::filesystem::path& folder,
                                        const IsolationLimits& limits = {}, bool textures = false);

/// The mesh of a binary file of MuJoCo; the hull of its points if it has no faces. Throws Error for a file
/// that is not right to the byte.
[[nodiscard]] TriangleMesh readMsh(std::string_view bytes, const std::string& name);

/// As readMesh() or, with `textures`, readTexturedMesh(), with the turn of the mesh.
[[nodiscard]] TexturedMesh readFile(const std::filesystem::path& file, bool textures);

}  // namespace rex::mesh
