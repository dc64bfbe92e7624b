#pragma once

#include "render/picture.h"

namespace rex {

/// The ellipsoid of all x with (x - mean)' covariance^-1 (x - mean) <= sigmas^2, for a Gaussian in W, in
/// metres and square metres. With sigmas = 2 it contains 74 % of the samples. It is flat in directions of
/// zero variance. Throws Error for numbers that are not finite, a matrix that is not symmetric or has a
/// negative eigenvalue (both up to rounding), or sigmas that are not positive.
[[nodiscard]] Ellipsoid covarianceEllipsoid(const Eigen::Vector3d& mean, const Eigen::Matrix3d& covariance,
                                            double sigmas = 2, const Color& color = Ellipsoid{}.color);

}  // namespace rex
