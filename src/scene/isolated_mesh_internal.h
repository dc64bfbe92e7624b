#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "base/isolated_call.h"
#include "geometry/triangle_mesh.h"

namespace rex::mesh {

/// The same as readByAssimp() in a process of its own, so that no file harms this one. Throws Error, too, for
/// a file on which assimp crashes, takes longer or needs more memory than the limits.
[[nodiscard]] TriangleMesh readIsolated(std::string_view bytes, const std::string& name,
                                        const std::filesystem::path& folder,
                                        const IsolationLimits& limits = {});

}  // namespace rex::mesh
