#pragma once

#include <Eigen/Core>

namespace rex {

/// A sensor that sees points from a planar pose x = (x, y, heading), as the car of exercise 12.9 does.
struct LandmarkSensor {
  enum class Kind {
    kCartesian,    ///< y = R(heading)^T (l - p): metres ahead and to the left
    kRangeBearing  ///< y = (distance, angle from the heading)
  };
  Kind kind = Kind::kCartesian;
  Eigen::Matrix2d W = Eigen::Matrix2d::Identity();  ///< covariance of the noise
};

/// What the sensor would see, and how that depends on pose and landmark.
struct LandmarkView {
  Eigen::Vector2d y;
  Eigen::Matrix<double, 2, 3> Jx;  ///< dy/dx
  Eigen::Matrix2d Jl;              ///< dy/dl
};
/// Throws Error where range and bearing have no derivative: a landmark less than 1e-9 m away.
[[nodiscard]] LandmarkView viewOf(const LandmarkSensor& sensor, const Eigen::Vector3d& x,
                                  const Eigen::Vector2d& landmark);

/// The landmark that is seen as y, and how it depends on pose and observation.
struct LandmarkPlace {
  Eigen::Vector2d landmark;
  Eigen::Matrix<double, 2, 3> Jx;  ///< dl/dx
  Eigen::Matrix2d Jy;              ///< dl/dy
};
/// Throws Error for a range that is not positive.
[[nodiscard]] LandmarkPlace placeOf(const LandmarkSensor& sensor, const Eigen::Vector3d& x,
                                    const Eigen::Vector2d& y);

/// seen - expected, bearings the shorter way round.
[[nodiscard]] Eigen::Vector2d innovation(const LandmarkSensor& sensor, const Eigen::Vector2d& seen,
                                         const Eigen::Vector2d& expected);

}  // namespace rex
