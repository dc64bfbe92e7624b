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

}  // namespace rex
