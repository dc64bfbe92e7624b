#include "geometry/rotation.h"

#include <cmath>
#include <numbers>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "base/error.h"

namespace rex {
namespace {

// Below this angle the first terms of the Taylor series are exact to machine precision.
constexpr double kTinyAngle = 1e-4;

// sin(t)/t, (1 - cos t)/t^2 and (t - sin t)/t^3.
struct Sinc {
  double a, b, c;
};

Sinc sincs(double t) {
  const double t2 = t * t;
  if (t < kTinyAngle) return {1 - t2 / 6, 0.5 - t2 / 24, 1. / 6 - t2 / 120};
  const double half = std::sin(t / 2) / t;
  // t - sin t loses digits for small t: below 0.1 five series terms are exact to the last bit.
  const double c =
      t < 0.1 ? 1. / 6 - t2 / 120 + t2 * t2 / 5040 - t2 * t2 * t2 / 362880 : (t - std::sin(t)) / (t2 * t);
  return {std::sin(t) / t, 2 * half * half, c};
}

// v scaled to length 1, even if the squares of its components would overflow or underflow; zero stays zero.
template <class Vector>
Vector unit(const Vector& v) {
  constexpr double kLeast = 1e-140, kMost = 1e140;
  const double largest = v.cwiseAbs().maxCoeff();
  if (largest == 0) return v;
  const Vector scaled = largest > kLeast && largest < kMost ? v : Vector(v / largest);
  return scaled / scaled.norm();
}

}  // namespace

Eigen::Matrix3d skew(const Eigen::Vector3d& w) {
  Eigen::Matrix3d W;
  W << 0, -w.z(), w.y(), w.z(), 0, -w.x(), -w.y(), w.x(), 0;
  return W;
}

Eigen::Matrix3d rotationAboutAxis(double angle, const Eigen::Vector3d& axis) {
  if (axis.isZero(0) || angle == 0) return Eigen::Matrix3d::Identity();
  const Eigen::Vector3d a = unit(axis);
  const double s = std::sin(angle), c = std::cos(angle);
  return c * Eigen::Matrix3d::Identity() + s * skew(a) + (1 - c) * a * a.transpose();
}

Eigen::Matrix3d expSO3(const Eigen::Vector3d& w) {
  const Sinc k = sincs(w.norm());
  const Eigen::Matrix3d W = skew(w);
  return Eigen::Matrix3d::Identity() + k.a * W + k.b * W * W;
}

bool isRotation(const Eigen::Matrix3d& R, double tolerance) {
  const double off = (R * R.transpose() - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
  return off <= tolerance && R.determinant() > 0;
}

Eigen::Vector3d logSO3(const Eigen::Matrix3d& R) {
  const Quaternion q = quaternionFromRotation(R);
  const Eigen::Vector3d v = q.tail<3>();
  const double s = v.norm();
  // angle / sin(angle/2), with w >= 0; the series covers s -> 0.
  const double scale =
      s < kTinyAngle ? 2 / q[0] * (1 - s * s / (3 * q[0] * q[0])) : 2 * std::atan2(s, q[0]) / s;
  return scale * v;
}

Eigen::Matrix3d leftJacobianSO3(const Eigen::Vector3d& w) {
  const Sinc k = sincs(w.norm());
  const Eigen::Matrix3d W = skew(w);
  return Eigen::Matrix3d::Identity() + k.b * W + k.c * W * W;
}

Eigen::Matrix3d rightJacobianSO3(const Eigen::Vector3d& w) { return leftJacobianSO3(w).transpose(); }

Eigen::Matrix3d rotationFromQuaternion(const Quaternion& q) {
  if (!q.allFinite() || q.isZero(0)) {
    throw Error({.what = "quaternion",
                 .found = fmt::format("({}, {}, {}, {})", q[0], q[1], q[2], q[3]),
                 .wanted = "finite numbers, not all zero"});
  }
  const Quaternion u = unit(q);
  const double w = u[0], x = u[1], y = u[2], z = u[3];
  Eigen::Matrix3d R;
  R << 1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y),  //
      2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x),   //
      2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y);
  return R;
}

Quaternion quaternionFromRotation(const Eigen::Matrix3d& R) {
  // Shepperd's method: divide by the largest of the four components, never by a small one.
  const Eigen::Vector4d squares(R.trace(), R(0, 0), R(1, 1), R(2, 2));
  Eigen::Index largest;
  squares.maxCoeff(&largest);
  Quaternion q;
  if (largest == 0) {
    q << 1 + R.trace(), R(2, 1) - R(1, 2), R(0, 2) - R(2, 0), R(1, 0) - R(0, 1);
  } else {
    const Eigen::Index i = largest - 1, j = (i + 1) % 3, k = (i + 2) % 3;
    q[0] = R(k, j) - R(j, k);
    q[1 + i] = 1 + R(i, i) - R(j, j) - R(k, k);
    q[1 + j] = R(j, i) + R(i, j);
    q[1 + k] = R(k, i) + R(i, k);
  }
  q.normalize();
  return q[0] < 0 ? Quaternion(-q) : q;
}

Quaternion quaternionProduct(const Quaternion& a, const Quaternion& b) {
  const Eigen::Vector3d u = a.tail<3>(), v = b.tail<3>();
  Quaternion product;
  product << a[0] * b[0] - u.dot(v), a[0] * v + b[0] * u + u.cross(v);
  return product;
}

Eigen::Matrix3d rotationFromRollPitchYaw(const Eigen::Vector3d& rollPitchYaw) {
  return rotationAboutAxis(rollPitchYaw[2], Eigen::Vector3d::UnitZ()) *
         rotationAboutAxis(rollPitchYaw[1], Eigen::Vector3d::UnitY()) *
         rotationAboutAxis(rollPitchYaw[0], Eigen::Vector3d::UnitX());
}

Eigen::Vector3d rollPitchYawFromRotation(const Eigen::Matrix3d& R) {
  const double cosPitch = std::hypot(R(0, 0), R(1, 0));
  const double pitch = std::atan2(-R(2, 0), cosPitch);
  const double roll = cosPitch < 1e-15 ? 0 : std::atan2(R(2, 1), R(2, 2));
  // Near pitch = pi/2 the roll is ill-defined; the second column of R Rx(-roll) gives the yaw that matches
  // it.
  const double c = std::cos(roll), s = std::sin(roll);
  return {roll, pitch, std::atan2(R(0, 2) * s - R(0, 1) * c, R(1, 1) * c - R(1, 2) * s)};
}

Eigen::Matrix3d rotationBetween(const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  if (from.isZero(0) || to.isZero(0)) {
    throw Error(
        {.what = "rotation between two directions", .found = "a zero vector", .wanted = "two directions"});
  }
  const Eigen::Vector3d a = unit(from), b = unit(to);
  const Eigen::Vector3d axis = a.cross(b);
  const double sine = axis.norm(), cosine = a.dot(b);
  if (sine > 1e-12) return rotationAboutAxis(std::atan2(sine, cosine), axis);
  if (cosine > 0) return Eigen::Matrix3d::Identity();
  return rotationAboutAxis(std::numbers::pi, a.unitOrthogonal());
}

double wrapAngle(double angle) {
  const double wrapped = std::remainder(angle, 2 * std::numbers::pi);
  return wrapped <= -std::numbers::pi ? std::numbers::pi : wrapped;
}

}  // namespace rex
