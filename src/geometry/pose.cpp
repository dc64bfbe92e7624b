#include "geometry/pose.h"

#include "geometry/rotation.h"

namespace rex {

Pose translation(double x, double y, double z) { return {Eigen::Matrix3d::Identity(), {x, y, z}}; }

Pose rotation(double angle, const Eigen::Vector3d& axis) {
  return {rotationAboutAxis(angle, axis), Eigen::Vector3d::Zero()};
}

bool isApprox(const Pose& a, const Pose& b, double tolerance) {
  return (a.R - b.R).cwiseAbs().maxCoeff() <= tolerance && (a.p - b.p).cwiseAbs().maxCoeff() <= tolerance;
}

}  // namespace rex
