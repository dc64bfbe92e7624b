#pragma once

#include <string>

#include "geometry/triangle_mesh.h"

namespace rex {

/// The mesh with its lengths along x, y and z multiplied by `scale`. Negative factors mirror it; its
/// outside stays outside. Smooth edges stay smooth, however sharply they bend after scaling. Throws Error
/// naming the file `name` if |scale| is not between 1e-9 and 1e9 or a vertex would be beyond 1e6 m.
[[nodiscard]] TriangleMesh scaledMesh(const TriangleMesh& mesh, const Eigen::Vector3d& scale,
                                      const std::string& name);

/// The mesh turned by R about its origin.
[[nodiscard]] TriangleMesh turnedMesh(const TriangleMesh& mesh, const Eigen::Matrix3d& R);

}  // namespace rex
