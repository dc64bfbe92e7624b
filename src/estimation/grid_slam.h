#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "estimation/ekf_slam.h"
#include "estimation/occupancy_map.h"

namespace rex {

class Rng;

struct GridSlamOptions {
  int particles = 30;
  /// Poses are drawn around the match of the scan with the particle's map; false: from the motion alone.
  bool matchScans = true;
  double threshold = 0.5;   ///< resample if the effective sample size falls below this fraction
  double deviation = 0.03;  ///< standard deviation of end points of rays about walls of the map, metres
  /// Rays of one scan are not independent: the log weight that a scan adds is divided by this, at least 1.
  double temper = 3;
  int draws = 10;  ///< drawn around each match; one of them is kept
  RayEvidence evidence{};
};

struct GridSlamStep {
  double effectiveSize = 0;  ///< after weighing
  bool resampled = false;
};

/// SLAM with grid maps by a Rao-Blackwellised particle filter: each particle is a path of poses with the
/// occupancy map that its scans draw. The proposal is a Gaussian around the match of the scan with the
/// particle's own map. Slides 7:33 and 7:39; Haehnel et al. 2003, Grisetti, Stachniss and Burgard 2007.
class GridSlam {
 public:
  /// All particles start at the pose, with `empty` as map to which the first scan is added. Throws Error
  /// like OccupancyMap::observe, and for options out of range.
  GridSlam(const Eigen::Vector3d& pose, const OccupancyMap& empty, const RangeScanner& scanner,
           const VectorArg& ranges, const GridSlamOptions& options = {});

  /// Moves all particles, weights them by the scan and adds it to their maps. Throws Error for a transition
  /// without a mean or with a noise that is not a covariance (with scan matching: not definite), and like
  /// OccupancyMap::observe; then nothing but rng has changed.
  GridSlamStep step(const PoseTransition& transition, const VectorArg& ranges, Rng& rng);

  [[nodiscard]] Eigen::Matrix3Xd poses() const;                ///< one particle per column
  const Eigen::VectorXd& weights() const { return weights_; }  ///< sum to one
  /// The particle whose ancestors explained all scans best.
  [[nodiscard]] int likeliest() const;
  /// The map and the path of a particle, from its start. Throws Error if it does not exist.
  [[nodiscard]] const OccupancyMap& map(int particle) const;
  [[nodiscard]] Eigen::Matrix3Xd path(int particle) const;

 private:
  /// The end points of rays in one cell, and points between neighbouring ones.
  struct Hits {
    Eigen::Vector2f sum{0, 0};  ///< from the origin of the map
    float count = 0;
    Eigen::Vector2f normal =
        Eigen::Vector2f::Zero();  ///< of the wall through neighbours; zero unless straight
  };
  struct Particle {
    OccupancyMap map;
    std::vector<Hits> hits;  // of each cell
    std::vector<Eigen::Vector3d> path;
    double logWeight = 0;  // of the whole path
  };
  struct Target;  // what a particle is drawn from

  void add(Particle& particle, const Eigen::Vector3d& pose, const VectorArg& ranges) const;
  void fitWall(Particle& particle, const Eigen::Vector2i& cell) const;
  void resample(Rng& rng);

  RangeScanner scanner_;
  GridSlamOptions options_;
  std::vector<Particle> particles_;
  Eigen::VectorXd weights_;
};

}  // namespace rex
