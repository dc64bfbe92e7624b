#pragma once

#include <span>
#include <string>

#include "grasping/wrench_cone.h"

namespace rex {

/// kUndecided: the wrenches lie so near to the border between both that rounding decides.
enum class ClosureStatus { kClosed, kOpen, kUndecided };

/// Whether wrenches can counteract any other, with a proof that holds by substitution.
struct Closure {
  ClosureStatus status = ClosureStatus::kUndecided;
  int rank = 0;  ///< dimensions that the wrenches span
  /// kClosed, N: all positive, sum one, and wrenches * weights = 0. Else empty.
  Eigen::VectorXd weights{};
  /// kOpen, d: a unit vector with direction.w >= 0 for every wrench w, so that nothing counteracts a wrench
  /// along it, and no contact stops a motion along it; far from them all where there are many. Else, and
  /// without contacts, empty.
  Eigen::VectorXd direction{};
  /// kClosed: the largest number of sum w_i weights_i / |w_i|, divided by the smallest such weight; kOpen:
  /// how far the lowest direction.w / |w| lies below zero. Below 1e-9 for both. Of contacts both are seen
  /// from their middle, with torques divided by the distance of the one that lies farthest from it.
  double residual = 0;
  std::string message{};
};

/// Whether the positive span of the wrenches (d x N, one per column) is the whole space: slide 10:6. That is
/// so if they have rank d and minus their sum is a positive combination of them, which a linear program
/// tells; otherwise the theorem of Stiemke gives the direction. No wrenches are open. Undecided, too, where
/// the least singular value of the unit wrenches lies between 1e-12 and 1e-9. Throws Error for no rows and
/// for numbers that are not finite.
[[nodiscard]] Closure forceClosure(const MatrixArg& wrenches);

/// A verdict on exact cones, and the wrenches that it speaks of: edges of a pyramid, and those on rims that
/// decided. Of an open grasp `direction` holds for all wrenches of the cones.
struct ConeClosure {
  Closure closure{};
  WrenchSet set{};
};

/// Force closure with exact friction cones: pyramids get further edges where their open direction is not that
/// of the cones. The contacts are looked at from their middle, in units of their spread, so that the
/// WrenchReference does not matter; farther from it than some 1e5 times the spread rounding decides. Throws
/// as primitiveWrenches().
[[nodiscard]] ConeClosure forceClosure(std::span<const WrenchCone> cones);

/// Form closure of first order: force closure without friction, slide 10:7. Needs d + 1 contacts. Throws as
/// above.
[[nodiscard]] Closure formClosure(std::span<const WrenchCone> cones);

}  // namespace rex
