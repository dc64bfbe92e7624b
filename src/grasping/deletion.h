#pragma once

#include <span>
#include <string>
#include <vector>

#include "grasping/closure.h"

namespace rex {

/// What is left of many contacts when those are deleted that are not needed.
struct DeletionSynthesis {
  ClosureStatus status = ClosureStatus::kUndecided;  ///< of all contacts together
  std::vector<int> kept{};  ///< kClosed: the contacts that hold alone, each of them needed; in order
  Closure closure{};        ///< of the edges of those; if not kClosed, of all
  std::string message{};
};

/// Mishra's synthesis of a grasp (Mishra, Schwartz and Sharir, 1987; slide 10:8): put fingers everywhere, and
/// while one is redundant, delete it. A finger is redundant if the rest still has force closure, of pyramids
/// of `edges` edges. Fingers are tried in `order`, all of them once, first those that one would rather not
/// have. At most 2 d contacts stay: 6 in the plane, 12 in space (theorem of Steinitz). Throws Error as
/// primitiveWrenches(), and for an order that does not name each contact once.
[[nodiscard]] DeletionSynthesis deleteRedundant(std::span<const WrenchCone> cones, std::span<const int> order,
                                                int edges = 8);

/// In the order of the contacts.
[[nodiscard]] DeletionSynthesis deleteRedundant(std::span<const WrenchCone> cones, int edges = 8);

}  // namespace rex
