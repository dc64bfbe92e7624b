#include <algorithm>

#include "scene/opaque_mesh_internal.h"

namespace rex {
namespace {

bool isInvisible(const TriangleMesh::Part& part) { return part.color && (*part.color)[3] == 0; }

}  // namespace

bool hasInvisiblePart(const TriangleMesh& mesh) {
  return std::any_of(mesh.parts().begin(), mesh.parts().end(), isInvisible);
}

TriangleMesh withoutInvisibleParts(const TriangleMesh& mesh) {
  std::vector<TriangleMesh::Part> parts(mesh.parts().begin(), mesh.parts().end());
  for (TriangleMesh::Part& part : parts)
    if (isInvisible(part)) (*part.color)[3] = 1;
  return {{mesh.positions().begin(), mesh.positions().end()},
          {mesh.normals().begin(), mesh.normals().end()},
          {mesh.triangles().begin(), mesh.triangles().end()},
          std::move(parts),
          mesh.paint()};
}

}  // namespace rex
