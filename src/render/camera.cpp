#include "render/camera.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "base/error.h"

namespace rex {

bool Bounds::isEmpty() const { return (low.array() > high.array()).any(); }

Eigen::Vector3d Bounds::center() const { return (low + high) / 2; }

double Bounds::radius() const { return (high - low).norm() / 2; }

Eigen::Vector3d Bounds::corner(int i) const {
  return {(i & 1 ? high : low).x(), (i & 2 ? high : low).y(), (i & 4 ? high : low).z()};
}

void Bounds::include(const Eigen::Vector3d& point) {
  low = low.cwiseMin(point);
  high = high.cwiseMax(point);
}

namespace {

// Axes of a camera that looks along -`back` (unit length), with z up in the picture.
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

// Where the eye may stand so that corners (u, z) lie within the frustum |u - e_u| <= slope * (e_z - z) of
// one picture axis: at e_z = `distance` only at e_u = `middle`, for larger e_z in an interval around it.
struct AxisFit {
  double middle, distance;
};

AxisFit fitAxis(const Eigen::Matrix<double, 3, 8>& corners, int axis, double slope) {
  const Eigen::Array<double, 1, 8> u = corners.row(axis).array(), lean = slope * corners.row(2).array();
  const double highest = (u + lean).maxCoeff(), lowest = (u - lean).minCoeff();
  return {(highest + lowest) / 2, (highest - lowest) / (2 * slope)};
}

// The e_u for a given e_z that leaves the same margin on both sides: the frustum narrows until it fits
// tightly.
double centredEye(const Eigen::Matrix<double, 3, 8>& corners, int axis, double slope, double eyeZ) {
  double narrow = 0, wide = slope;
  for (int i = 0; i < 60; ++i) {
    const double middle = (narrow + wide) / 2;
    (fitAxis(corners, axis, middle).distance > eyeZ ? narrow : wide) = middle;
  }
  return fitAxis(corners, axis, wide).middle;
}

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
  if (bounds.isEmpty())
    throw Error({.what = "nothing to draw",
                 .found = "no shape, line, point, arrow or label in the scene",
                 .wanted = "at least one"});
  if (!bounds.low.allFinite() || !bounds.high.allFinite()) throw fail("infinite bounds", "finite ones");
  if (!direction.allFinite() || direction.norm() == 0) throw fail("no view direction", "a finite vector");
  if (!(aspect > 0) || !std::isfinite(aspect))
    throw fail("a strange aspect ratio", "width / height, positive");

  Camera camera;
  camera.X_WC.R = axesLookingAgainst(direction.normalized());
  const double slopeY = std::tan(camera.verticalFov / 2) / kMargin;
  const double slopeX = slopeY * aspect;
  Eigen::Matrix<double, 3, 8> corners;  // in C, for an eye at the origin of W
  for (int i = 0; i < 8; ++i) corners.col(i) = camera.X_WC.R.transpose() * bounds.corner(i);
  const double front = corners.row(2).maxCoeff();
  // A single point has no size; stand half a metre away from it.
  const double radius = bounds.radius() > 0 ? bounds.radius() : 0.5;
  const double eyeZ =
      std::max({fitAxis(corners, 0, slopeX).distance, fitAxis(corners, 1, slopeY).distance, front + radius});
  const Eigen::Vector3d eye_C(centredEye(corners, 0, slopeX, eyeZ), centredEye(corners, 1, slopeY, eyeZ),
                              eyeZ);
  camera.X_WC.p = camera.X_WC.R * eye_C;
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
