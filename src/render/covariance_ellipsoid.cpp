#include "render/covariance_ellipsoid.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <fmt/format.h>

#include "base/error.h"
#include "base/require.h"

namespace rex {

Ellipsoid covarianceEllipsoid(const Eigen::Vector3d& mean, const Eigen::Matrix3d& covariance, double sigmas,
                              const Color& color) {
  constexpr double kRounding = 1e-9;  // of the largest entry
  const auto fail = [](std::string found, const char* wanted) {
    return Error({.what = "covariance ellipsoid", .found = std::move(found), .wanted = wanted});
  };
  if (!mean.allFinite() || !covariance.allFinite())
    throw fail("a mean or covariance that is not finite", "finite numbers");
  requirePositive("covariance ellipsoid: sigmas", sigmas);
  const double rounding = kRounding * covariance.cwiseAbs().maxCoeff();
  if ((covariance - covariance.transpose()).cwiseAbs().maxCoeff() > rounding)
    throw fail("a covariance that is not symmetric", "a symmetric one");
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(covariance);
  const Eigen::Vector3d variances = eigen.eigenvalues();
  if (variances.minCoeff() < -rounding)
    throw fail(fmt::format("a variance of {} along one axis", variances.minCoeff()), "variances >= 0");
  Ellipsoid ellipsoid{.X_WE = {.R = eigen.eigenvectors(), .p = mean}, .color = color};
  ellipsoid.X_WE.R.col(2) = ellipsoid.X_WE.R.col(0).cross(ellipsoid.X_WE.R.col(1));
  ellipsoid.radii = sigmas * variances.cwiseMax(0).cwiseSqrt();
  return ellipsoid;
}

}  // namespace rex
