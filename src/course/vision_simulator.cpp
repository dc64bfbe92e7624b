#include "course/vision_simulator.h"

#include <cmath>
#include <numbers>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "base/error.h"
#include "base/require.h"

namespace rex {

VisionSimulator::VisionSimulator(std::uint64_t seed) : rng_(seed) {
  X_WC_.p = Eigen::Vector3d(10, -15, 8);
  const Eigen::Vector3d back = X_WC_.p.normalized();  // the camera looks along -z
  const Eigen::Vector3d right = Eigen::Vector3d::UnitZ().cross(back).normalized();
  X_WC_.R << right, back.cross(right), back;
  const double half = kPixels / 2.0;
  const double focal = half / std::tan(6 * std::numbers::pi / 180);
  // Depth is -z of the camera.
  Eigen::Matrix3d K;
  K << focal, 0, -half, 0, focal, -half, 0, 0, -1;
  P_ << K * X_WC_.R.transpose(), -K * X_WC_.R.transpose() * X_WC_.p;
}

Eigen::Matrix4Xd VisionSimulator::getRandomWorldPoints(int count) {
  requireCount("points", count, 0);
  Eigen::Matrix4Xd points(4, count);
  for (auto point : points.colwise()) point << rng_.uniformVector(3, -1, 1), 1;
  return points;
}

Eigen::Matrix3Xd VisionSimulator::projectWorldPoints(const Eigen::Matrix4Xd& points, double noise) {
  requireFinite("points", points.reshaped());
  requireNotNegative("noise of pixels", noise);
  Eigen::Matrix3Xd pixels = P_ * points;
  for (Eigen::Index i = 0; i < pixels.cols(); ++i) {
    // The third number is the depth times the scale of the point.
    if (!(pixels(2, i) * points(3, i) > 0))
      throw Error({.what = fmt::format("point {}", i),
                   .found = "a position behind the camera",
                   .wanted = "one in front of it"});
    pixels.col(i) /= pixels(2, i);
    pixels.col(i).head<2>() += noise * rng_.normalVector(2);
  }
  return pixels;
}

}  // namespace rex
