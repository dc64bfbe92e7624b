#pragma once

#include <span>
#include <string>
#include <vector>

#include "grasping/closure.h"

namespace rex {

/// What remains of many contacts after deleting the redundant ones.
struct DeletionSynthesis {
  ClosureStatus status = ClosureStatus::kUndecided;  ///< for all contacts together
  std::vector<int> kept{};  ///< kClosed: the contacts that suffice, each of them needed; ascending
  Closure closure{};        ///< for the edges of those; if not kClosed, for all
  std::string message{};
};

/// Mishra's synthesis of a grasp (Mishra, Schwartz and Sharir, 1987; slide 10:8): put fingers everywhere,
/// and delete one while any is redundant. A finger is redundant if the others still have force closure with
/// pyramids of `edges` edges. Fingers are tried once each in `order`, so put the least wanted first. At
/// most 2 d contacts remain: 6 in the plane, 12 in space (Steinitz's theorem). Throws Error like
/// primitiveWrenches(), and for an order that does not name each contact once.
[[nodiscard]] DeletionSynthesis deleteRedundant(std::span<const WrenchCone> cones, std::span<const int> order,
                                                int edges = 8);

/// The same, trying the contacts in their own order.
[[nodiscard]] DeletionSynthesis deleteRedundant(std::span<const WrenchCone> cones, int edges = 8);

}  // namespace rex
