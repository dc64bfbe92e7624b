#pragma once

#include <functional>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "estimation/ekf_slam.h"
#include "estimation/fast_slam.h"
#include "estimation/landmark_sensor.h"

namespace rex {

/// The column assigned to each row such that no two rows share one and the sum of their costs is minimal:
/// shortest augmenting paths with potentials (Kuhn 1955, Munkres 1957; Jonker and Volgenant 1987). Throws
/// Error for costs that are not finite and for more rows than columns.
[[nodiscard]] std::vector<int> cheapestAssignment(const Eigen::MatrixXd& cost);

class Rng;

struct UnnamedFastSlamOptions {
  int particles = 100;
  bool observedProposal = false;  ///< as in FastSlamOptions
  double threshold = 0.5;         ///< as in FastSlamOptions
  /// An observation is a new landmark if no landmark of the particle has a larger expected likelihood than
  /// the sensor's noise has at this squared Mahalanobis distance (chi-square with 2 degrees: 99.99 %).
  double gate = 18.42;
  /// Whether the sensor at pose x would observe a landmark. A particle removes a landmark that it should
  /// have observed, and did not, more often than it did. Empty: landmarks are never removed.
  std::function<bool(const Eigen::Vector3d& x, const Eigen::Vector2d& landmark)> isInView{};
};

/// A landmark of the map that the particles share.
struct MappedLandmark {
  Gaussian position{};     ///< mean and covariance of the mixture of the particles that have it
  double probability = 0;  ///< their weight
};

/// FastSLAM without names: each particle decides for itself which landmarks it observes, by the largest
/// expected likelihood, or that they are new. Slide 7:41; Montemerlo 2003; Thrun, Burgard and Fox,
/// Probabilistic Robotics, table 13.1. The observations of a step belong to different landmarks: the
/// likeliest such assignment is taken.
class FastSlamUnknownAssociation {
 public:
  /// All particles start at the pose. Throws Error like FastSlam, and for a gate that is not positive.
  FastSlamUnknownAssociation(const Eigen::Vector3d& pose, const LandmarkSensor& sensor,
                             const UnnamedFastSlamOptions& options = {});

  /// Moves all particles, lets each associate the observations and weights them. No particle is ever lost:
  /// what no landmark explains is a new one. Throws Error like FastSlam; then nothing but rng has changed.
  FastSlamStep step(const PoseTransition& transition, std::span<const Eigen::Vector2d> ys, Rng& rng);

  const Eigen::Matrix3Xd& poses() const { return poses_; }     ///< one particle per column
  const Eigen::VectorXd& weights() const { return weights_; }  ///< sum to one
  [[nodiscard]] Eigen::Vector3d meanPose() const;              ///< headings averaged on the circle
  /// The landmarks of one particle. Throws Error if it does not exist.
  [[nodiscard]] std::vector<LandmarkBelief> landmarks(int particle) const;
  /// The landmarks that are in the maps of particles with a weight of at least `least`, in the order of
  /// first appearance. Particles have the same landmark if it comes from the same observation.
  [[nodiscard]] std::vector<MappedLandmark> map(double least = 0.5) const;

 private:
  struct Landmark {
    LandmarkBelief belief{};
    int origin = 0;    // the number of the observation that brought it
    int evidence = 1;  // how often it was observed, less how often it was missed
  };
  using Map = std::vector<Landmark>;

  void move(Eigen::Index particle, const PoseTransition& transition, const Eigen::Matrix3d& root,
            std::span<const Eigen::Vector2d> ys, double& logWeight, Rng& rng);
  [[nodiscard]] std::vector<int> associate(const Map& map, const Eigen::Vector3d& pose,
                                           const Eigen::Matrix3d& P,
                                           std::span<const Eigen::Vector2d> ys) const;

  LandmarkSensor sensor_;
  UnnamedFastSlamOptions options_;
  double newLandmark_ = 0;  // log likelihood of an observation of a new one
  Eigen::Matrix3Xd poses_;
  Eigen::VectorXd weights_;
  std::vector<Map> maps_;
  int observations_ = 0;  // so far
};

}  // namespace rex
