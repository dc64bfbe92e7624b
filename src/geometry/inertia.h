#pragma once

#include <Eigen/Core>

namespace rex {

/// What keeps a matrix from being the inertia of any distribution of mass: a negative principal moment, or
/// one that is larger than the sum of the two others (the triangle inequality).
enum class InertiaFault { kNone, kNegative, kTriangle };

/// Judges a symmetric inertia about the centre of mass, kg m^2; a millionth of its trace is forgiven.
[[nodiscard]] InertiaFault inertiaFault(const Eigen::Matrix3d& I);

/// The principal moments of a symmetric inertia, ascending, kg m^2.
[[nodiscard]] Eigen::Vector3d principalMoments(const Eigen::Matrix3d& I);

/// The symmetric matrix nearest to I, by the sum of its squared entries, that has no negative principal
/// moment: those of I become 0, its axes stay (Higham 1988).
[[nodiscard]] Eigen::Matrix3d nearestWithoutNegativeMoments(const Eigen::Matrix3d& I);

}  // namespace rex
