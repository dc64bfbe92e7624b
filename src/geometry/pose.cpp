#include "geometry/pose.h"

#include <cmath>

#include <Eigen/LU>

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

namespace {

// The matrix [[a, -b], [b, a]] of eq. (158), which maps the linear part of a planar twist to the
// displacement: a = sin(w)/w, b = (1 - cos w)/w.
Eigen::Matrix2d planarDisplacement(double w) {
  const bool tiny = std::abs(w) < 1e-4;
  const double a = tiny ? 1 - w * w / 6 : std::sin(w) / w;
  const double b = tiny ? w / 2 - w * w * w / 24 : 2 * std::sin(w / 2) * std::sin(w / 2) / w;
  Eigen::Matrix2d V;
  V << a, -b, b, a;
  return V;
}

}  // namespace

Pose expSE3(const Vector6d& twist) {
  const Eigen::Vector3d v = twist.head<3>(), w = twist.tail<3>();
  return {expSO3(w), leftJacobianSO3(w) * v};
}

Vector6d logSE3(const Pose& X) {
  const Eigen::Vector3d w = logSO3(X.R);
  Vector6d twist;
  twist << leftJacobianSO3(w).inverse() * X.p, w;
  return twist;
}

Eigen::Vector3d expSE2(const Eigen::Vector3d& twist) {
  Eigen::Vector3d pose;
  pose << planarDisplacement(twist[2]) * twist.head<2>(), wrapAngle(twist[2]);
  return pose;
}

Eigen::Vector3d logSE2(const Eigen::Vector3d& pose) {
  const double w = wrapAngle(pose[2]);
  Eigen::Vector3d twist;
  twist << planarDisplacement(w).inverse() * pose.head<2>(), w;
  return twist;
}

}  // namespace rex
