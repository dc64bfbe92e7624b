#pragma once

#include <Eigen/Core>

namespace rex {

/// A sensor that observes points from a planar pose x = (x, y, heading), like the car of exercise 12.9.
struct LandmarkSensor {
  enum class Kind {
    kCartesian,    ///< y = R(heading)^T (l - p): metres ahead and to the left
    kRangeBearing  ///< y = (distance, angle from the heading)
  };
  Kind kind = Kind::kCartesian;
  Eigen::Matrix2d W = Eigen::Matrix2d::Identity();  ///< covariance of the noise
};

/// What a particle knows about the position of a landmark.
struct LandmarkBelief {
  Eigen::Vector2d mean{0, 0};
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();
};

/// The predicted observation, and its derivatives.
struct LandmarkView {
  Eigen::Vector2d y;
  Eigen::Matrix<double, 2, 3> Jx;  ///< dy/dx
  Eigen::Matrix2d Jl;              ///< dy/dl
};
/// The observation of `landmark` from pose x. Throws Error if range and bearing are not differentiable: for
/// a landmark less than 1e-9 m away.
[[nodiscard]] LandmarkView landmarkView(const LandmarkSensor& sensor, const Eigen::Vector3d& x,
                                        const Eigen::Vector2d& landmark);

/// The position of the landmark observed as y, and its derivatives.
struct LandmarkPlace {
  Eigen::Vector2d landmark;
  Eigen::Matrix<double, 2, 3> Jx;  ///< dl/dx
  Eigen::Matrix2d Jy;              ///< dl/dy
};
/// The inverse of landmarkView(). Throws Error for a range that is not positive.
[[nodiscard]] LandmarkPlace landmarkPosition(const LandmarkSensor& sensor, const Eigen::Vector3d& x,
                                             const Eigen::Vector2d& y);

/// seen - expected, with bearing differences wrapped.
[[nodiscard]] Eigen::Vector2d innovation(const LandmarkSensor& sensor, const Eigen::Vector2d& seen,
                                         const Eigen::Vector2d& expected);

}  // namespace rex
