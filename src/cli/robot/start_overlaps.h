#pragma once

#include <string>
#include <vector>

#include "physics/physics_world.h"

namespace rex::cli {

/// Two overlapping bodies, or shapes of the world.
struct BodyOverlap {
  std::string a, b;
  double depth = 0;  ///< metres, at its deepest
};

/// The pairs that may collide and overlap by more than 0.1 mm in that state, deepest first. Throws Error
/// like PhysicsWorld.
[[nodiscard]] std::vector<BodyOverlap> startOverlaps(const Model& model, const PhysicsOptions& options,
                                                     const State& start);

/// "2 pairs: 'a' and 'b' by 0.012 m, ...", for at most the deepest dozen.
[[nodiscard]] std::string toString(const std::vector<BodyOverlap>& overlaps);

}  // namespace rex::cli
