#pragma once

#include <Eigen/Core>

#include "geometry/pose.h"

namespace rex {

/// A camera without distortion, found from points that it sees. It looks along its -z axis; pixels (u, v)
/// count to the right and upwards.
struct CameraCalibration {
  Eigen::Matrix<double, 3, 4> P{};    ///< pixel ~ P X; the last row gives depths in metres
  Pose X_WC{};                        ///< of the camera in the world
  Eigen::Vector2d focal{}, centre{};  ///< pixels, along u and v
  double skew = 0;        ///< pixels: how far u moves per unit of y / depth, 0 for rectangular pixels
  double rms = 0;         ///< distance of seen and projected pixels, root mean square
  double initialRms = 0;  ///< of the direct linear transform alone
  Eigen::Matrix<double, 6, 1> deviation{};  ///< of X_WC.p (m), focal (pixels) and skew, for the noise of rms
  bool isRefined = false;                   ///< whether the refinement converged
};

/// The camera that sees `points` (3 x n, metres, world) at `pixels` (2 x n), n at least 6: by the direct
/// linear transform with normalised coordinates, refined until the sum of squared distances in the image is
/// least (Hartley and Zisserman 2004, algorithm 7.1). Throws Error for counts that do not fit, numbers that
/// are not finite, and points that do not determine the camera, such as those in one plane.
[[nodiscard]] CameraCalibration calibratedCamera(const Eigen::Matrix3Xd& points,
                                                 const Eigen::Matrix2Xd& pixels);

}  // namespace rex
