#pragma once

#include "geometry/triangle_mesh.h"

namespace rex {

/// Whether a part has a colour with an alpha of 0, so that it would not be seen.
[[nodiscard]] bool hasInvisiblePart(const TriangleMesh& mesh);

/// The same mesh with an alpha of 1 where it is 0.
[[nodiscard]] TriangleMesh withoutInvisibleParts(const TriangleMesh& mesh);

}  // namespace rex
