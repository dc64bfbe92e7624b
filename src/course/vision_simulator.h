#pragma once

#include <Eigen/Core>

#include "base/rng.h"
#include "geometry/pose.h"

namespace rex {

/// A camera that looks at points, for its calibration: 400 x 400 pixels, a field of view 12 degrees high,
/// at (10, -15, 8), looking along its -z axis at the origin. Pixels count from the lower left.
class VisionSimulator {
 public:
  static constexpr int kPixels = 400;

  explicit VisionSimulator(std::uint64_t seed = 0);

  /// `count` points, uniform in [-1, 1]^3, homogeneous: 4 x count. Throws Error for a negative count.
  [[nodiscard]] Eigen::Matrix4Xd getRandomWorldPoints(int count);
  /// Their image points (u, v, 1), with normal noise of standard deviation `noise` in pixels. Throws Error
  /// for negative noise, points that are not finite, and points that are not in front of the camera.
  [[nodiscard]] Eigen::Matrix3Xd projectWorldPoints(const Eigen::Matrix4Xd& points, double noise = 1);
  /// The true matrix: pixel ~ P X.
  [[nodiscard]] const Eigen::Matrix<double, 3, 4>& getProjection() const { return P_; }
  [[nodiscard]] const Pose& getCameraPose() const { return X_WC_; }

 private:
  Pose X_WC_;
  Eigen::Matrix<double, 3, 4> P_;
  Rng rng_;
};

}  // namespace rex
