#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "estimation/building.h"
#include "estimation/scan_walk.h"
#include "exercise.h"

// Simulated buildings of 12 x 12 m: a corridor around a block, with furniture.

inline rex::Building randomBuilding(rex::Rng& rng) {
  rex::Building building;
  building.addBox(.3, .3, 11.4, 11.4);
  const double left = rng.uniform(3.6, 4.4), below = rng.uniform(3.6, 4.4), right = rng.uniform(7.6, 8.4),
               above = rng.uniform(7.6, 8.4);
  building.addBox(left, below, right - left, above - below);
  // Along each outer wall two pieces, and a pillar at each side of the block.
  for (int side = 0; side < 4; ++side) {
    const double depth = rng.uniform(.5, 1), far = 11.7 - depth;
    for (int k = 0; k < 2; ++k) {
      const double length = rng.uniform(.6, 1.8), at = rng.uniform(1 + 5. * k, 4.2 + 5. * k);
      if (side < 2)
        building.addBox(at, side == 0 ? .3 : far, length, depth);
      else
        building.addBox(side == 2 ? .3 : far, at, depth, length);
    }
    const double middle = rng.uniform(4.8, 6.8), size = rng.uniform(.3, .6);
    if (side < 2)
      building.addBox(middle, side == 0 ? below - size : above, .5, size);
    else
      building.addBox(side == 2 ? left - size : right, middle, size, .5);
  }
  return building;
}

inline rex::RangeScanner scannerOf(int rays, double maxRange) {
  rex::RangeScanner scanner{.angles = {}, .maxRange = maxRange};
  for (int k = 0; k < rays; ++k) scanner.angles.push_back(2 * std::acos(-1.) * k / rays);
  return scanner;
}

inline Scan scanOf(const rex::RangeScanner& scanner, const Eigen::VectorXd& ranges) {
  return {Eigen::VectorXd::Map(scanner.angles.data(), static_cast<Eigen::Index>(scanner.angles.size())),
          ranges, scanner.maxRange};
}

/// A map of a building in which nothing is known.
inline Grid emptyGrid() { return {{0, 0}, .2, Eigen::MatrixXd::Zero(60, 60)}; }

/// The true map of a building: 5 in cells with a wall, -5 in all others, 0 outside of it.
inline Grid gridOf(const rex::Building& building) {
  Grid grid = emptyGrid();
  rex::OccupancyMap map(60, 60, grid.cell, grid.origin);
  rex::rasterize(building, map);
  for (int i = 0; i < 60; ++i)
    for (int j = 0; j < 60; ++j)
      grid.values(i, j) = std::min(i, j) < 1 || std::max(i, j) > 58 ? 0 : map.logOdds(i, j);
  return grid;
}

/// What a robot measures in a building, and where it was.
struct Tour {
  rex::Building building{};
  std::vector<Eigen::Vector3d> truth{};
  Log log{};
};

/// With the true poses in the columns of `poses`.
inline Tour tourOf(const rex::Building& building, const Eigen::Matrix3Xd& poses, rex::Rng& rng) {
  const rex::RangeScanner scanner = scannerOf(45, 6.5);
  const rex::ScanWalk walk =
      rex::measured(building, poses, scanner, {.odometry = Settings{}.odometry, .range = .02}, rng);
  Tour tour{.building = building};
  tour.log.start = poses.col(0);
  for (Eigen::Index t = 0; t < poses.cols(); ++t) {
    tour.truth.emplace_back(poses.col(t));
    if (t > 0) tour.log.motions.emplace_back(walk.odometry.col(t));
    tour.log.scans.push_back(scanOf(scanner, walk.ranges.col(t)));
  }
  return tour;
}

/// Root mean square distance of the positions of two paths of the same length, metres.
inline double pathError(const std::vector<Eigen::Vector3d>& path, const std::vector<Eigen::Vector3d>& truth) {
  double sum = 0;
  for (std::size_t t = 0; t < path.size(); ++t)
    sum += std::pow(path[t][0] - truth[t][0], 2) + std::pow(path[t][1] - truth[t][1], 2);
  return std::sqrt(sum / static_cast<double>(path.size()));
}

/// The path by odometry alone.
inline std::vector<Eigen::Vector3d> reckoned(const Log& log) {
  std::vector<Eigen::Vector3d> path{log.start};
  for (const Eigen::Vector3d& motion : log.motions) path.push_back(rex::movedPose(path.back(), motion));
  return path;
}
