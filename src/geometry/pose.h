#pragma once

#include <Eigen/Core>

namespace rex {

/// A rigid transform X_AB, the pose of frame B in frame A: R_AB (3 x 3, a rotation) and p_AB (metres).
/// Names follow share/doc/notation.md: X_AB * X_BC = X_AC, and X_AB * p_BQ = p_AQ.
struct Pose {
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
  Eigen::Vector3d p{0, 0, 0};

  // Not inline: whatever includes this, a student's file above all, would instantiate these products to
  // compile.
  [[nodiscard]] Pose operator*(const Pose& other) const;
  [[nodiscard]] Eigen::Vector3d operator*(const Eigen::Vector3d& point) const;
  [[nodiscard]] Pose inverse() const;
};

/// The pose that translates by (x, y, z) metres.
[[nodiscard]] Pose translation(double x, double y, double z);
/// The pose that rotates by `angle` radians about `axis` (any length; a zero axis or angle gives the
/// identity).
[[nodiscard]] Pose rotation(double angle, const Eigen::Vector3d& axis);
/// Whether both poses agree within `tolerance` in every entry of R and p.
[[nodiscard]] bool isApprox(const Pose& a, const Pose& b, double tolerance);

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
