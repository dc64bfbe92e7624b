#include "render/camera.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "base/error.h"

namespace rex {
namespace {

// Axes of a camera that looks against `back` (unit length) with z up in the picture.
Eigen::Matrix3d axesLookingAgainst(const Eigen::Vector3d& back) {
  constexpr double kAlmostVertical = 1 - 1e-9;
  const Eigen::Vector3d up =
      std::abs(back.z()) > kAlmostVertical ? Eigen::Vector3d::UnitX() : Eigen::Vector3d::UnitZ();
  Eigen::Matrix3d R_WC;
  R_WC.col(0) = up.cross(back).normalized();
  R_WC.col(1) = back.cross(R_WC.col(0));
  R_WC.col(2) = back;
  return R_WC;
}

// The frustum along one picture axis is |u - e_u| <= slope * (e_z - z). For the corners (u, z) this leaves an
// interval for e_u that shrinks to `middle` when the eye comes as near as `distance`.
struct AxisFit {
  double highest = -std::numeric_limits<double>::infinity();
  double lowest = std::numeric_limits<double>::infinity();
  void include(double u, double z, double slope) {
    highest = std::max(highest, u + slope * z);
    lowest = std::min(lowest, u - slope * z);
  }
  double middle() const { return (highest + lowest) / 2; }
  double distance(double slope) const { return (highest - lowest) / (2 * slope); }
};

}  // namespace

Camera lookAt(const Eigen::Vector3d& eye, const Eigen::Vector3d& target) {
  const Eigen::Vector3d back = eye - target;
  if (!back.allFinite() || back.norm() == 0)
    throw Error({.what = "camera",
                 .found = fmt::format("eye ({}, {}, {}) looking at ({}, {}, {})", eye.x(), eye.y(), eye.z(),
                                      target.x(), target.y(), target.z()),
                 .wanted = "two different finite points"});
  Camera camera;
  camera.X_WC = {axesLookingAgainst(back.normalized()), eye};
  return camera;
}

Camera framing(const Bounds& bounds, const Eigen::Vector3d& direction, double aspect) {
  constexpr double kMargin = 1.12;  // the scene takes 1/kMargin of the picture
  const auto fail = [](const char* found, const char* wanted) {
    return Error({.what = "cannot frame the scene", .found = found, .wanted = wanted});
  };
  if (bounds.isEmpty()) throw fail("empty bounds", "something to look at");
  if (!bounds.low.allFinite() || !bounds.high.allFinite()) throw fail("infinite bounds", "finite ones");
  if (!direction.allFinite() || direction.norm() == 0) throw fail("no view direction", "a finite vector");
  if (!(aspect > 0) || !std::isfinite(aspect)) throw fail("a strange aspect", "width / height, positive");

  Camera camera;
  camera.X_WC.R = axesLookingAgainst(direction.normalized());
  const double slopeY = std::tan(camera.verticalFov / 2) / kMargin;
  const double slopeX = slopeY * aspect;
  AxisFit fitX, fitY;
  double front = -std::numeric_limits<double>::infinity();
  for (int i = 0; i < 8; ++i) {
    const Eigen::Vector3d p_C = camera.X_WC.R.transpose() * bounds.corner(i);
    fitX.include(p_C.x(), p_C.z(), slopeX);
    fitY.include(p_C.y(), p_C.z(), slopeY);
    front = std::max(front, p_C.z());
  }
  // A single point has no size; stand a metre away from it.
  const double radius = bounds.radius() > 0 ? bounds.radius() : 0.25;
  const double eyeZ = std::max({fitX.distance(slopeX), fitY.distance(slopeY), front + radius});
  camera.X_WC.p = camera.X_WC.R * Eigen::Vector3d(fitX.middle(), fitY.middle(), eyeZ);
  const double toCenter = (camera.X_WC.p - bounds.center()).norm();
  camera.nearPlane = std::max((eyeZ - front) / 2, toCenter / 200);
  camera.farPlane = toCenter + 40 * radius;
  return camera;
}

std::optional<PixelPoint> project(const Camera& camera, const Eigen::Vector3d& p_WQ, int width, int height) {
  const Eigen::Vector3d p_CQ = camera.X_WC.inverse() * p_WQ;
  const double depth = -p_CQ.z();
  if (!(depth > 0)) return std::nullopt;
  const double focal = height / (2 * std::tan(camera.verticalFov / 2));
  return PixelPoint{width / 2.0 + focal * p_CQ.x() / depth, height / 2.0 - focal * p_CQ.y() / depth, depth};
}

Eigen::Matrix4d clipFromWorld(const Camera& camera, double aspect) {
  const double focal = 1 / std::tan(camera.verticalFov / 2);
  const double near = camera.nearPlane, far = camera.farPlane;
  Eigen::Matrix4d clipFromCamera = Eigen::Matrix4d::Zero();
  clipFromCamera(0, 0) = focal / aspect;
  clipFromCamera(1, 1) = focal;
  clipFromCamera(2, 2) = (near + far) / (near - far);
  clipFromCamera(2, 3) = 2 * near * far / (near - far);
  clipFromCamera(3, 2) = -1;
  const Pose X_CW = camera.X_WC.inverse();
  Eigen::Matrix4d cameraFromWorld = Eigen::Matrix4d::Identity();
  cameraFromWorld.topLeftCorner<3, 3>() = X_CW.R;
  cameraFromWorld.topRightCorner<3, 1>() = X_CW.p;
  return clipFromCamera * cameraFromWorld;
}

}  // namespace rex
