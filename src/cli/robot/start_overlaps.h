#pragma once

#include <string>
#include <vector>

#include "physics/physics_world.h"

namespace rex::cli {

/// Two bodies, or shapes of the world, that are in overlap.
struct BodyOverlap {
  std::string a, b;
  double depth = 0;  ///< metres, at its deepest
};

/// What may collide and is deeper than 0.1 mm in overlap in that state, deepest first. Throws Error as
/// PhysicsWorld.
[[nodiscard]] std::vector<BodyOverlap> startOverlaps(const Model& model, const PhysicsOptions& options,
                                                     const State& start);

/// "2 pairs: 'a' and 'b' by 0.012 m, ...", of the deepest dozen.
[[nodiscard]] std::string toString(const std::vector<BodyOverlap>& overlaps);

}  // namespace rex::cli
