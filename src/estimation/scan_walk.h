#pragma once

#include <vector>

#include <Eigen/Core>

#include "estimation/building.h"
#include "estimation/ekf_slam.h"
#include "estimation/occupancy_map.h"

namespace rex {

class Rng;

/// Poses (x, y, heading) along straight lines between points, at most `step` metres and `turn` radians
/// apart; the robot turns on the spot. Throws Error for fewer than two points, numbers that are not finite,
/// points that coincide with the one before, and a step or turn that is not positive.
[[nodiscard]] Eigen::Matrix3Xd posesAlong(const std::vector<Eigen::Vector2d>& points, double step,
                                          double turn);

/// A walk in a building as a robot knows it, and where it was.
struct ScanWalk {
  Eigen::Matrix3Xd truth{};
  Eigen::Matrix3Xd odometry{};  ///< measured motion to each pose, in the frame of the pose before; first zero
  Eigen::MatrixXd ranges{};     ///< one scan per column
};
/// Standard deviations of the simulated measurements.
struct WalkNoise {
  Eigen::Vector3d odometry{0.03, 0.03, 0.02};  ///< of each motion: metres, metres, radians
  double range = 0.02;                         ///< metres
};
/// Measures a walk along true poses. Throws Error like noisyRanges, and for negative deviations.
[[nodiscard]] ScanWalk measured(const Building& building, const Eigen::Matrix3Xd& poses,
                                const RangeScanner& scanner, const WalkNoise& noise, Rng& rng);

/// The pose after a motion that is given in the frame of the pose before: x, y, heading.
[[nodiscard]] Eigen::Vector3d movedPose(const Eigen::Vector3d& pose, const Eigen::Vector3d& motion);
/// How a pose moves by measured odometry. Deviations in x and y must be equal, so that the noise is the same
/// for all headings; throws Error if they are not, and for negative ones.
[[nodiscard]] PoseTransition odometryTransition(const Eigen::Vector3d& motion,
                                                const Eigen::Vector3d& deviations);

}  // namespace rex
