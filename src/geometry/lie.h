#pragma once

#include <Eigen/Core>

#include "geometry/pose.h"

namespace rex {

using Vector6d = Eigen::Matrix<double, 6, 1>;

/// SE(3) exponential of a twist (v, w): linear part first, metres and radians. Sola et al. 2018, eq. (172).
[[nodiscard]] Pose expSE3(const Vector6d& twist);
/// SE(3) logarithm with |w| <= pi: expSE3(logSE3(X)) = X. Sola et al. 2018, eq. (173).
[[nodiscard]] Vector6d logSE3(const Pose& X);

/// SE(2) exponential: the pose (x, y, heading) reached from the origin after driving the twist (vx, vy, w)
/// for one unit of time; heading in (-pi, pi]. Sola et al. 2018, eq. (156).
[[nodiscard]] Eigen::Vector3d expSE2(const Eigen::Vector3d& twist);
/// SE(2) logarithm of (x, y, heading); the heading is wrapped first. Sola et al. 2018, eq. (157).
[[nodiscard]] Eigen::Vector3d logSE2(const Eigen::Vector3d& pose);

}  // namespace rex
