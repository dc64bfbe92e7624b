#include "estimation/landmark_sensor.h"

#include <cmath>

#include <fmt/format.h>

#include "base/error.h"
#include "base/require.h"
#include "geometry/rotation.h"

namespace rex {

LandmarkView landmarkView(const LandmarkSensor& sensor, const Eigen::Vector3d& x,
                          const Eigen::Vector2d& landmark) {
  const Eigen::Vector2d d = landmark - x.head<2>();
  LandmarkView view;
  if (sensor.kind == LandmarkSensor::Kind::kCartesian) {
    const double c = std::cos(x[2]), s = std::sin(x[2]);
    view.y << c * d[0] + s * d[1], -s * d[0] + c * d[1];
    view.Jl << c, s, -s, c;
    view.Jx << -view.Jl, Eigen::Vector2d(view.y[1], -view.y[0]);
    return view;
  }
  const double range = d.norm();
  if (range < 1e-9)
    throw Error({.what = "landmark seen by range and bearing",
                 .found = fmt::format("a distance of {:g} m", range),
                 .wanted = "a landmark away from the sensor"});
  const Eigen::Vector2d ahead = d / range, across(-ahead[1], ahead[0]);
  view.y << range, wrapAngle(std::atan2(d[1], d[0]) - x[2]);
  view.Jl << ahead.transpose(), across.transpose() / range;
  view.Jx << -view.Jl, Eigen::Vector2d(0, -1);
  return view;
}

LandmarkPlace landmarkPosition(const LandmarkSensor& sensor, const Eigen::Vector3d& x,
                               const Eigen::Vector2d& y) {
  LandmarkPlace place;
  Eigen::Vector2d d;  // from the pose, in world axes
  if (sensor.kind == LandmarkSensor::Kind::kCartesian) {
    const double c = std::cos(x[2]), s = std::sin(x[2]);
    place.Jy << c, -s, s, c;
    d = place.Jy * y;
  } else {
    requirePositive("range of a new landmark", y[0], kMetres);
    const double c = std::cos(x[2] + y[1]), s = std::sin(x[2] + y[1]);
    place.Jy << c, -y[0] * s, s, y[0] * c;
    d = y[0] * Eigen::Vector2d(c, s);
  }
  place.landmark = x.head<2>() + d;
  place.Jx << Eigen::Matrix2d::Identity(), Eigen::Vector2d(-d[1], d[0]);
  return place;
}

Eigen::Vector2d innovation(const LandmarkSensor& sensor, const Eigen::Vector2d& seen,
                           const Eigen::Vector2d& expected) {
  Eigen::Vector2d difference = seen - expected;
  if (sensor.kind == LandmarkSensor::Kind::kRangeBearing) difference[1] = wrapAngle(difference[1]);
  return difference;
}

}  // namespace rex
