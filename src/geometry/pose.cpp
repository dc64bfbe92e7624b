#include "geometry/pose.h"

#include "geometry/rotation.h"

namespace rex {

Pose Pose::operator*(const Pose& other) const { return {R * other.R, R * other.p + p}; }

Eigen::Vector3d Pose::operator*(const Eigen::Vector3d& point) const { return R * point + p; }

Pose Pose::inverse() const { return {R.transpose(), -(R.transpose() * p)}; }

Pose translation(double x, double y, double z) { return {Eigen::Matrix3d::Identity(), {x, y, z}}; }

Pose rotation(double angle, const Eigen::Vector3d& axis) {
  return {rotationAboutAxis(angle, axis), Eigen::Vector3d::Zero()};
}

bool isApprox(const Pose& a, const Pose& b, double tolerance) {
  return (a.R - b.R).cwiseAbs().maxCoeff() <= tolerance && (a.p - b.p).cwiseAbs().maxCoeff() <= tolerance;
}

}  // namespace rex
