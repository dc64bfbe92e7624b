#pragma once

#include <memory>

#include <btBulletCollisionCommon.h>

#include "geometry/shape.h"

namespace rex::internal {

/// A solid for Bullet, in the same frame; meshes and clouds become their convex hulls. None for markers and
/// for meshes that are not loaded.
[[nodiscard]] std::unique_ptr<btCollisionShape> bulletShape(const Shape& shape);

}  // namespace rex::internal
