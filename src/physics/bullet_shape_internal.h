#pragma once

#include <memory>

#include <LinearMath/btTransform.h>
#include <btBulletCollisionCommon.h>

#include "geometry/pose.h"
#include "geometry/rotation.h"
#include "geometry/shape.h"
#include "scene/model.h"

namespace rex::internal {

inline btVector3 toBullet(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }
inline Eigen::Vector3d fromBullet(const btVector3& v) { return {v.x(), v.y(), v.z()}; }

/// The rotation R; of Bullet's quaternions the real part comes last.
inline btQuaternion bulletQuaternion(const Eigen::Matrix3d& R) {
  const Quaternion q = quaternionFromRotation(R);
  return {q[1], q[2], q[3], q[0]};
}

inline btTransform toBullet(const Pose& X) {
  const Eigen::Matrix3d& R = X.R;
  return btTransform(
      btMatrix3x3(R(0, 0), R(0, 1), R(0, 2), R(1, 0), R(1, 1), R(1, 2), R(2, 0), R(2, 1), R(2, 2)),
      toBullet(X.p));
}

inline Pose fromBullet(const btTransform& X) {
  Pose pose;
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column) pose.R(row, column) = X.getBasis()[row][column];
  pose.p = fromBullet(X.getOrigin());
  return pose;
}

/// A solid for Bullet, in the same frame; meshes and clouds become their convex hulls. None for markers and
/// for meshes that are not loaded.
[[nodiscard]] std::unique_ptr<btCollisionShape> bulletShape(const Shape& shape);

/// What each of Model::links() has to move along its coordinate with all that hangs on it, were all other
/// joints locked: kg m^2, of sliders kg, of quaternions the least of their three. In the initial posture.
[[nodiscard]] std::vector<double> linkInertias(const Model& model);

}  // namespace rex::internal
