#pragma once

#include <vector>

#include "scene/model.h"

namespace rex::internal {

/// A motion that one of Bullet's joints can make, about or along an axis of the joint's frame. kNone: it
/// only holds its bodies together.
struct ElementaryMove {
  enum class Kind { kNone, kTurn, kSlide, kBall };
  Kind kind = Kind::kNone;
  Eigen::Vector3d axis = Eigen::Vector3d::UnitX();
};

/// The moves that one after the other make up X_FM, in the order of the joint's coordinates; at least one.
/// Throws Error for screws, whose turn drives their way.
[[nodiscard]] std::vector<ElementaryMove> elementaryMoves(const Joint& joint);

}  // namespace rex::internal
