#pragma once

#include <vector>

#include "course/course.h"

// The functions you complete in main.cpp. Metres and radians; left turns are positive. A pose is (x, y,
// heading), and a heading may be any angle: two that differ by whole turns are the same. Slides are named as
// chapter:number.

/// Square cells with a number each: a map (log odds of being occupied; 0: unknown), or distances. Cell (i, j)
/// is the i-th along x and the j-th along y, from 0 on; its number is values(i, j).
struct Grid {
  Eigen::Vector2d origin = Eigen::Vector2d::Zero();  ///< lower left corner of cell (0, 0)
  double cell = 0.2;                                 ///< length of its sides
  Eigen::MatrixXd values{};
};

/// What a range scanner measures: one range for each ray. A range of maxRange or more: the ray hit nothing.
struct Scan {
  Eigen::VectorXd angles{};  ///< of the rays, from the heading of the robot
  Eigen::VectorXd ranges{};
  double maxRange = 6.5;
};

// Part 1, a grid map of known poses (7:33).

/// The cell (i, j) in which a point lies, also if it is outside of the grid. Points on a border are not
/// tested.
Eigen::Vector2i cellAt(const Grid& grid, const Eigen::Vector2d& p);

/// All cells that the segment passes, also those outside of the grid, each once and in order: from the one of
/// `from` to the one of `to`. Cells in which the segment is shorter than a hundredth of a side are optional.
std::vector<Eigen::Vector2i> cellsAlong(const Grid& grid, const Eigen::Vector2d& from,
                                        const Eigen::Vector2d& to);

/// What a scan adds to the log odds of a cell, and the largest size that they may have.
struct CellEvidence {
  double hit = 1.5, miss = -0.6, bound = 6;
};

/// The map after a scan from a known pose. `hit` is added once to each cell in which a ray ends, and `miss`
/// once to each other cell that a ray passes. A ray that hit nothing passes all cells up to maxRange, the
/// one there included. Then log odds are limited to [-bound, bound]; those of the given map are within
/// already. Rays may leave the grid.
Grid observed(const Grid& map, const Eigen::Vector3d& pose, const Scan& scan, const CellEvidence& evidence);

// Part 2, how well a scan fits.

/// For each cell of the map, the distance of its centre from the centre of the nearest occupied cell (log
/// odds above 0), but at most `reach`.
Grid wallDistances(const Grid& map, double reach);

/// A value between the centres of cells: bilinear in the four around p. Outside of the rectangle of the
/// outermost centres it is the value at the nearest point of that rectangle. The grid has at least 2 x 2
/// cells.
double valueAt(const Grid& grid, const Eigen::Vector2d& p);

/// The log likelihood of a scan at a pose, up to a constant: minus the sum of d^2 / (2 deviation^2) over all
/// rays that hit something, where d is the distance at the end point of the ray.
double fit(const Grid& distances, const Eigen::Vector3d& pose, const Scan& scan, double deviation);

// Part 3, scan matching.

/// The pose with the best fit among those that differ from the guess by at most window[0] in x and in y, and
/// by at most window[1] in heading. A fit of at least best - 1 - 0.05 (best - fit(guess)) is accepted.
Eigen::Vector3d matched(const Grid& distances, const Scan& scan, double deviation,
                        const Eigen::Vector3d& guess, const Eigen::Vector2d& window);

// Part 4, Rao-Blackwellised particles (7:39).

/// `count` poses after a motion that odometry measured in the frame of the pose before: (ahead, left, turn).
/// Independent noise with these standard deviations is added to its three numbers for each pose. 3 x count.
Eigen::Matrix3Xd moved(const Eigen::Vector3d& pose, const Eigen::Vector3d& motion,
                       const Eigen::Vector3d& deviations, int count, rex::Rng& rng);

/// A path of poses, the map that follows from it and the scans, and the logarithm of its weight.
struct Particle {
  std::vector<Eigen::Vector3d> path{};  ///< not empty; the robot is at the last pose
  Grid map{};
  double logWeight = 0;
};

/// The weights of all particles, with sum one. logWeight is finite, but its exponential may be zero or
/// infinite for each of them.
Eigen::VectorXd weightsOf(const std::vector<Particle>& particles);

/// One over the sum of the squared weights.
double effectiveSize(const Eigen::VectorXd& weights);

/// N particles, each a copy of one of the N given ones, in any order. Particle i occurs N weight_i times on
/// average, and never less often than the integer part of that. All log weights are 0 afterwards.
std::vector<Particle> resampled(const std::vector<Particle>& particles, rex::Rng& rng);

struct Settings {
  Eigen::Vector3d odometry{0.04, 0.04, 0.03};  ///< standard deviations of each motion, for moved()
  bool matches = true;                         ///< whether poses are matched
  Eigen::Vector2d window{0.25, 0.15};          ///< for matched()
  double reach = 0.6;                          ///< for wallDistances()
  double deviation = 0.15;                     ///< for fit()
  double temper = 6;       ///< rays are not independent: what fit() says is divided by it in weights
  double threshold = 0.5;  ///< resample if the effective size is below this share of the particles
  CellEvidence evidence{};
};

/// The particles after a motion and a scan, in the same order. Each draws a pose by moved(); with
/// settings.matches, it is replaced by the match of the scan with its own map near it. How well the scan
/// fits its map there, divided by `temper`, is added to its log weight. Only then is the scan added to its
/// map. An exact weight would also have the density of the motion over that of the drawn pose (7:25) as a
/// factor. Without it, long corridors become too short.
std::vector<Particle> slamStep(const std::vector<Particle>& particles, const Eigen::Vector3d& motion,
                               const Scan& scan, const Settings& settings, rex::Rng& rng);

/// What a robot measured: scans[0] at the start, scans[t + 1] after motions[t].
struct Log {
  Eigen::Vector3d start = Eigen::Vector3d::Zero();
  std::vector<Eigen::Vector3d> motions{};
  std::vector<Scan> scans{};
};

struct Mapped {
  std::vector<Eigen::Vector3d> path{};  ///< from the start on
  Grid map{};
  std::vector<double> effectiveSizes{};  ///< after each motion and scan, before particles are resampled
};

/// SLAM with `count` particles that are all at the start at first, with the first scan in their maps; `empty`
/// is a map in which nothing is known. Returns the path and the map of a particle of the largest weight.
Mapped mapped(const Log& log, const Grid& empty, const Settings& settings, int count, rex::Rng& rng);

// Part 5, a bonus: anywhere.

/// The pose of a robot in a finished map, when only a scan is known: somewhere in a cell with log odds below
/// 0. Only one position fits well. Correct to 0.2 m and 0.1 rad.
Eigen::Vector3d located(const Grid& map, const Scan& scan, const Settings& settings);
