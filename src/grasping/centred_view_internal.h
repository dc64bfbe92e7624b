#pragma once

#include <span>

#include "grasping/closure.h"

namespace rex::internal {

/// Wrenches as seen from the middle of their contacts, with torques divided by the contacts' spread: an
/// invertible map, on which closure does not depend but rounding does.
struct CentredView {
  Eigen::MatrixXd map{};  ///< d x d, times a wrench
  double rounding = 0;    ///< of unit wrenches seen so: it grows with the distance of the reference point
};

/// The view of cones that have passed requireCones(). Where they are not those of contacts in space or in the
/// plane, wrenches stay as they are.
[[nodiscard]] CentredView centredView(std::span<const WrenchCone> cones);

/// forceClosure() of the wrenches (d x N) in this view, but for the direction, which is for the wrenches
/// themselves.
[[nodiscard]] Closure forceClosure(const Eigen::MatrixXd& wrenches, const CentredView& view);

}  // namespace rex::internal
