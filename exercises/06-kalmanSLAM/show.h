#pragma once

#include <cstdint>

#include "exercise.h"

/// A recorded drive: controls[t] leads from states[t] to states[t + 1], where seen[t] is seen.
struct RecordedDrive {
  double range = 0;           ///< metres; landmarks farther away are not seen
  Eigen::MatrixXd landmarks;  ///< 2 x N
  std::vector<Eigen::Vector2d> controls;
  std::vector<Eigen::Vector3d> states;
  std::vector<std::vector<LandmarkObservation>> seen;
};

/// The library's car drives from (0, 0, 0), with the same control in each step.
RecordedDrive recordDrive(std::uint64_t seed, const CarSetup& car, const Eigen::MatrixXd& landmarks,
                          int steps, const Eigen::Vector2d& u, double range);

/// All sightings in step t, 2 N numbers, of a drive that sees all landmarks in each step.
Eigen::VectorXd allSeen(const RecordedDrive& drive, std::size_t t);

/// Landmarks inside and outside the circle that u = (v, 0.2) drives, 2 x count.
Eigen::MatrixXd landmarksAround(int count);

/// Prints how far each derivative of part 1 is from finite differences of the function.
void showDerivatives();

/// steps.png: without noise, the controls of a drive lead round in a circle; the true path leaves it.
void showSteps(const CarSetup& car, const RecordedDrive& drive);

/// tracking.png: the filter (a belief for each state) stays on the true path. Without observations the
/// ellipses grow.
void showTracking(const RecordedDrive& drive, const std::vector<Belief>& run,
                  const std::vector<Belief>& blind);

/// consistency.png: the mean of 50 squared errors stays near 3 if the filter is consistent. Each run starts
/// with that belief.
void showConsistency(const Belief& start);

/// smoothing.png: errors stay within two standard deviations most of the time; the library's, dashed, lie on
/// yours.
void showSmoothing(const RecordedDrive& drive, const std::vector<Belief>& run,
                   const std::vector<Belief>& smooth);

/// slam.mp4, map_before.png, map_after.png, deviations.png, correlations.png, slam_error.png: Kalman SLAM of
/// a drive whose landmarks have names. When an early one comes back into view, all others become more
/// certain.
void showMap(const RecordedDrive& drive);

/// names.png: the map without names has as many landmarks as the car has seen.
void showNames(const RecordedDrive& drive);

/// particles.png: the poses of 100 particles, and the landmarks in their maps.
void showParticles(const RecordedDrive& drive);
