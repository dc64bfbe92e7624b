#pragma once

#include <functional>
#include <vector>

#include "collision/contact_model.h"

namespace rex::internal {

/// Two shapes that overlap in the initial posture, and how deep, metres.
struct HomeOverlap {
  ShapePair pair;
  double depth = 0;
};

/// All that are deeper than `tolerance`, of shapes that `isAsked` for, sorted by their shapes. A mesh that is
/// not loaded overlaps nothing.
[[nodiscard]] std::vector<HomeOverlap> homeOverlaps(
    const Model& model, double tolerance,
    const std::function<bool(const ModelShape&, const ModelShape&)>& isAsked);

/// Whether a shape takes part in collisions.
[[nodiscard]] inline bool takesPart(const ModelShape& shape) {
  return shape.contact && shape.shape.type != ShapeType::kMarker;
}

}  // namespace rex::internal
