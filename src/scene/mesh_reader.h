#pragma once

#include <filesystem>

#include "geometry/triangle_mesh.h"

namespace rex {

/// Reads a mesh from an STL, OBJ (with its MTL), PLY, DAE, glTF, GLB or OFF file; its lengths times `scale`
/// along x, y and z are metres. Nodes are put in their places, and normals made as by weldedMesh(): those of
/// the file do not count. Materials become parts with their base colour, without textures. A file without
/// triangles gives its points. Throws Error naming the file: missing, of another kind, over 256 MiB, faulty,
/// with numbers that are not finite or beyond 1e9 m, with more than ten million triangles or 5000 nodes below
/// each other (of glTF: nodes that have children), or with nothing but triangles without area.
[[nodiscard]] TriangleMesh readMesh(const std::filesystem::path& file,
                                    const Eigen::Vector3d& scale = Eigen::Vector3d::Ones());

}  // namespace rex
