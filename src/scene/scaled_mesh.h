#pragma once

#include <string>

#include "geometry/triangle_mesh.h"

namespace rex {

/// The mesh with its lengths along x, y and z times `scale`; negative numbers mirror it, and the outside
/// stays outside. Smooth edges stay smooth, however much they bend now. Throws Error naming the file `name`
/// where |scale| is not from 1e-9 to 1e9, or a vertex would be further out than 1e6 m.
[[nodiscard]] TriangleMesh scaledMesh(const TriangleMesh& mesh, const Eigen::Vector3d& scale,
                                      const std::string& name);

}  // namespace rex
