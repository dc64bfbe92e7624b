#pragma once

#include <Eigen/Core>

namespace rex {

/// The reason why a matrix cannot be the inertia of any mass distribution: a negative principal moment, or
/// one that is larger than the sum of the two others (the triangle inequality).
enum class InertiaFault { kNone, kNegative, kTriangle };

/// Checks a symmetric inertia about the centre of mass, kg m^2, with a tolerance of 1e-6 of its trace.
[[nodiscard]] InertiaFault inertiaFault(const Eigen::Matrix3d& I);

/// The principal moments of a symmetric inertia, ascending, kg m^2.
[[nodiscard]] Eigen::Vector3d principalMoments(const Eigen::Matrix3d& I);

/// The symmetric matrix without negative principal moments that is nearest to I in the Frobenius norm:
/// negative moments become 0, and the axes stay (Higham 1988).
[[nodiscard]] Eigen::Matrix3d nearestWithoutNegativeMoments(const Eigen::Matrix3d& I);

}  // namespace rex
