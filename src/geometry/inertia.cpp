#include "geometry/inertia.h"

#include <Eigen/Eigenvalues>

namespace rex {

InertiaFault inertiaFault(const Eigen::Matrix3d& I) {
  constexpr double kForgiven = 1e-6;
  const Eigen::Vector3d moments = I.selfadjointView<Eigen::Lower>().eigenvalues();  // ascending
  const double slack = kForgiven * moments.cwiseAbs().sum();
  if (moments[0] < -slack) return InertiaFault::kNegative;
  if (moments[2] > moments[0] + moments[1] + slack) return InertiaFault::kTriangle;
  return InertiaFault::kNone;
}

}  // namespace rex
