#pragma once

#include <Eigen/Core>

namespace rex {

/// A quaternion as in files and on slide 2:10: (w, x, y, z).
using Quaternion = Eigen::Vector4d;

/// [w]x, the matrix with [w]x v = w x v.
[[nodiscard]] Eigen::Matrix3d skew(const Eigen::Vector3d& w);

/// Rotation by `angle` radians about `axis` (any length; zero axis or angle: identity). Rodrigues, slide 2:9.
[[nodiscard]] Eigen::Matrix3d rotationAboutAxis(double angle, const Eigen::Vector3d& axis);
/// SO(3) exponential: the rotation by |w| radians about w.
[[nodiscard]] Eigen::Matrix3d expSO3(const Eigen::Vector3d& w);
/// SO(3) logarithm: the rotation vector w with |w| <= pi and expSO3(w) = R. Exact also near 0 and near pi.
[[nodiscard]] Eigen::Vector3d logSO3(const Eigen::Matrix3d& R);
/// Right Jacobian of SO(3): expSO3(w + d) ~ expSO3(w) expSO3(Jr(w) d). Sola, Deray, Atchuthan 2018, eq.
/// (143).
[[nodiscard]] Eigen::Matrix3d rightJacobianSO3(const Eigen::Vector3d& w);
/// Left Jacobian of SO(3), the transpose of the right one. Sola et al. 2018, eq. (145).
[[nodiscard]] Eigen::Matrix3d leftJacobianSO3(const Eigen::Vector3d& w);

/// Whether R is a rotation: R R^T = 1 within `tolerance` in every entry, and not mirrored.
[[nodiscard]] bool isRotation(const Eigen::Matrix3d& R, double tolerance = 1e-6);

/// The rotation of a quaternion of any length (slide 2:10). Throws Error if its norm is zero or not finite.
[[nodiscard]] Eigen::Matrix3d rotationFromQuaternion(const Quaternion& q);
/// The unit quaternion of R with w >= 0; stable for every R, unlike the slide's formula, which needs w != 0.
[[nodiscard]] Quaternion quaternionFromRotation(const Eigen::Matrix3d& R);
/// Product with R(a o b) = R(a) R(b); slide 2:10 with erratum 1.
[[nodiscard]] Quaternion quaternionProduct(const Quaternion& a, const Quaternion& b);

/// Rz(yaw) Ry(pitch) Rx(roll), angles in radians.
[[nodiscard]] Eigen::Matrix3d rotationFromRollPitchYaw(const Eigen::Vector3d& rollPitchYaw);
/// Inverse of the above with |pitch| <= pi/2; at |pitch| = pi/2, where only one sum is determined, roll = 0.
[[nodiscard]] Eigen::Vector3d rollPitchYawFromRotation(const Eigen::Matrix3d& R);

/// The smallest rotation that turns direction `from` to direction `to` (any lengths, not zero).
/// Opposite directions: a half turn about an axis perpendicular to both. Throws Error for a zero vector.
[[nodiscard]] Eigen::Matrix3d rotationBetween(const Eigen::Vector3d& from, const Eigen::Vector3d& to);

/// The angle in (-pi, pi] that differs from `angle` by a multiple of 2 pi.
[[nodiscard]] double wrapAngle(double angle);

}  // namespace rex
