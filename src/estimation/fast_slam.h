#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

#include "estimation/ekf_slam.h"
#include "estimation/landmark_sensor.h"
#include "estimation/resampling.h"

namespace rex {

class Rng;

/// An observation of a landmark, with its number.
struct LandmarkSighting {
  int landmark = 0;
  Eigen::Vector2d y{0, 0};
};

struct FastSlamOptions {
  int particles = 100;
  /// FastSLAM 2: poses are drawn where the sightings are likely (Montemerlo et al. 2003), instead of from
  /// the motion alone.
  bool observedProposal = false;
  double threshold = 0.5;  ///< resample if the effective sample size falls below this fraction
};

struct FastSlamStep {
  double effectiveSize = 0;  ///< after weighing
  bool resampled = false;
  bool lost = false;  ///< no particle explains the sightings: poses moved, weights and maps are unchanged
};

/// SLAM with particles: each particle is a path of poses with its own map of independent Gaussian
/// landmarks. Slides 7:39-7:42.
class FastSlam {
 public:
  /// All particles start at the pose. Throws Error for options out of range, a pose that is not finite, and a
  /// sensor whose W is not definite.
  FastSlam(const Eigen::Vector3d& pose, const LandmarkSensor& sensor, const FastSlamOptions& options = {});

  /// Moves all particles and weights them by the sightings. Landmarks are numbered from 0 in the order of
  /// first appearance. Throws Error like EkfSlam, and for a landmark that is neither known nor the next
  /// one; then nothing but rng has changed.
  FastSlamStep step(const PoseTransition& transition, std::span<const LandmarkSighting> sightings, Rng& rng);

  int landmarks() const { return landmarks_; }
  const Eigen::Matrix3Xd& poses() const { return poses_; }     ///< one particle per column
  const Eigen::VectorXd& weights() const { return weights_; }  ///< sum to one
  [[nodiscard]] Gaussian landmark(int particle, int i) const;  ///< throws Error if it does not exist
  /// Mean and covariance of the mixture of all particles. Throws Error if it does not exist.
  [[nodiscard]] Gaussian landmark(int i) const;
  [[nodiscard]] Eigen::Vector3d meanPose() const;  ///< headings averaged on the circle

 private:
  [[nodiscard]] LandmarkBelief& at(Eigen::Index particle, int i) {
    return maps_[static_cast<std::size_t>(particle) * static_cast<std::size_t>(room_) +
                 static_cast<std::size_t>(i)];
  }
  /// Moves the particles and updates their maps, however unlikely; returns the logarithms of the weights.
  Eigen::VectorXd advance(const PoseTransition& transition, std::span<const LandmarkSighting> known,
                          std::span<const LandmarkSighting> fresh, int landmarks, Rng& rng);
  void makeRoom(int landmarks);
  void resampleParticles(Rng& rng);

  LandmarkSensor sensor_;
  FastSlamOptions options_;
  Eigen::Matrix3Xd poses_;
  Eigen::VectorXd weights_;
  std::vector<LandmarkBelief> maps_;  // of each particle, `room_` landmarks
  int landmarks_ = 0, room_ = 8;
};

}  // namespace rex
