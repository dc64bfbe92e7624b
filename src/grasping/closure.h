#pragma once

#include <span>
#include <string>
#include <vector>

#include "grasping/wrench_cone.h"

namespace rex {

/// kUndecided: the wrenches are so close to the boundary between both that rounding decides.
enum class ClosureStatus { kClosed, kOpen, kUndecided };

/// Whether wrenches can counteract any other, with a proof that can be checked by substitution.
struct Closure {
  ClosureStatus status = ClosureStatus::kUndecided;
  int rank = 0;  ///< number of dimensions that the wrenches span
  /// kClosed, N: all positive, sum one, and wrenches * weights = 0. Else empty.
  Eigen::VectorXd weights{};
  /// kOpen, d: a unit vector with direction.w >= 0 for every wrench w, so nothing counteracts a wrench
  /// along it and no contact stops a motion along it. If there are many such vectors, it is far from all
  /// wrenches. Empty otherwise, and without contacts.
  Eigen::VectorXd direction{};
  /// kClosed: the largest entry of sum w_i weights_i / |w_i|, divided by the smallest such weight; kOpen:
  /// how far the lowest direction.w / |w| is below zero. Both are below 1e-9. For contacts, torques are
  /// taken about their centre and divided by the distance of the farthest contact from it.
  double residual = 0;
  std::string message{};
};

/// Whether the positive span of the wrenches (d x N, one per column) is the whole space: slide 10:6. That
/// holds if they have rank d and minus their sum is a positive combination of them, which a linear program
/// decides; otherwise Stiemke's theorem gives the direction. An empty set is open. Also undecided if the
/// smallest singular value of the unit wrenches is between 1e-12 and 1e-9. Throws Error if there are no
/// rows and for numbers that are not finite.
[[nodiscard]] Closure forceClosure(const MatrixArg& wrenches);

/// A verdict on exact cones, and the wrenches it refers to: the edges of a pyramid and the wrenches on the
/// cones' rims that decided. For an open grasp `direction` holds for all wrenches of the cones.
struct ConeClosure {
  Closure closure{};
  WrenchSet set{};
};

/// Force closure with exact friction cones: edges are added to the pyramids until their open direction is
/// also one of the cones. Torques are taken about the contacts' centre, in units of their spread, so the
/// WrenchReference does not matter unless it is more than about 1e5 spreads away, when rounding decides.
/// Throws like primitiveWrenches().
[[nodiscard]] ConeClosure forceClosure(std::span<const WrenchCone> cones);

/// First-order form closure: force closure without friction, slide 10:7 with erratum 44. Needs d + 1
/// contacts. Throws as above.
[[nodiscard]] Closure formClosure(std::span<const WrenchCone> cones);

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
