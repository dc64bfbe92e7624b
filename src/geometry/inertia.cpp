#include "geometry/inertia.h"

#include <Eigen/Eigenvalues>

namespace rex {

InertiaFault inertiaFault(const Eigen::Matrix3d& I) {
  constexpr double kForgiven = 1e-6;
  const Eigen::Vector3d moments = principalMoments(I);
  const double slack = kForgiven * moments.cwiseAbs().sum();
  if (moments[0] < -slack) return InertiaFault::kNegative;
  if (moments[2] > moments[0] + moments[1] + slack) return InertiaFault::kTriangle;
  return InertiaFault::kNone;
}

Eigen::Vector3d principalMoments(const Eigen::Matrix3d& I) {
  return I.selfadjointView<Eigen::Lower>().eigenvalues();
}

Eigen::Matrix3d nearestWithoutNegativeMoments(const Eigen::Matrix3d& I) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> principal(I);
  const Eigen::Matrix3d& R = principal.eigenvectors();
  const Eigen::Matrix3d nearest = R * principal.eigenvalues().cwiseMax(0).asDiagonal() * R.transpose();
  return (nearest + nearest.transpose()) / 2;
}

}  // namespace rex
