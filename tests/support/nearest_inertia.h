#pragma once

#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/Core>

namespace rex {

/// Whether `repaired` is the matrix without negative eigenvalues that is nearest to `given`, by Moreau's
/// conditions for a projection onto a cone: both it and the change have none, and they are orthogonal.
inline bool isNearestInertia(const Eigen::Matrix3d& repaired, const Eigen::Matrix3d& given) {
  const double scale = given.cwiseAbs().maxCoeff(), tiny = 1e-12;
  const Eigen::Matrix3d after = repaired / scale, change = (repaired - given) / scale;
  const auto hasNoNegative = [&](const Eigen::Matrix3d& A) {
    const Eigen::Matrix3d raised = A + tiny * Eigen::Matrix3d::Identity();
    return Eigen::LLT<Eigen::Matrix3d>(raised).info() == Eigen::Success;
  };
  return hasNoNegative(after) && hasNoNegative(change) && std::abs(after.cwiseProduct(change).sum()) <= tiny;
}

}  // namespace rex
