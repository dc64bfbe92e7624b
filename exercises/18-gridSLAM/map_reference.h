#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "buildings.h"
#include "estimation/occupancy_map.h"
#include "interface.h"

// What is right for a grid, by other ways than those that a student takes, and what usual mistakes make of
// it.

/// Rounded to two digits, so that a case can be computed by hand.
inline double rounded(double x) { return std::round(100 * x) / 100; }

/// A part of a segment within one cell, as long as that many sides of a cell.
struct Piece {
  Eigen::Vector2i cell;
  double length = 0;
};

/// The pieces of a segment between all borders that it crosses, in order.
inline std::vector<Piece> piecesOf(const Grid& grid, const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
  const Eigen::Vector2d a = (from - grid.origin) / grid.cell, way = (to - from) / grid.cell;
  std::vector<double> shares{0, 1};
  for (int k = 0; k < 2; ++k) {
    const double low = std::min(a[k], a[k] + way[k]), high = std::max(a[k], a[k] + way[k]);
    for (double border = std::ceil(low); border < high; ++border) shares.push_back((border - a[k]) / way[k]);
  }
  std::sort(shares.begin(), shares.end());
  std::vector<Piece> pieces;
  for (std::size_t i = 0; i + 1 < shares.size(); ++i) {
    const Eigen::Vector2d middle = a + .5 * (shares[i] + shares[i + 1]) * way;
    pieces.push_back({middle.array().floor().matrix().cast<int>(), (shares[i + 1] - shares[i]) * way.norm()});
  }
  return pieces;
}

inline Eigen::Vector2d endOf(const Eigen::Vector3d& pose, const Scan& scan, Eigen::Index k) {
  const double angle = pose[2] + scan.angles[k];
  return pose.head<2>() +
         std::min(scan.ranges[k], scan.maxRange) * Eigen::Vector2d(std::cos(angle), std::sin(angle));
}

/// What a scan is taken for: the right thing, or a mistake.
struct Reading {
  bool maxIsHit = false;       ///< a ray that hits nothing ends at a wall
  bool maxIsIgnored = false;   ///< ... or says nothing
  bool eachRayCounts = false;  ///< a cell gets what each ray says
  bool lastRayCounts = false;  ///< a cell gets what the last ray says
  bool isBounded = true;
  bool isAdded = true;
  double least = 0;  ///< shorter pieces of rays do not count
};

inline Grid mapAfter(const Grid& map, const Eigen::Vector3d& pose, const Scan& scan,
                     const CellEvidence& evidence, const Reading& reading = {}) {
  Grid change = map;
  change.values.setZero();
  for (Eigen::Index k = 0; k < scan.ranges.size(); ++k) {
    const bool isMax = scan.ranges[k] >= scan.maxRange, isHit = !isMax || reading.maxIsHit;
    if (isMax && reading.maxIsIgnored) continue;
    const std::vector<Piece> pieces = piecesOf(map, pose.head<2>(), endOf(pose, scan, k));
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      const int x = pieces[i].cell[0], y = pieces[i].cell[1];
      if (x < 0 || y < 0 || x >= map.values.rows() || y >= map.values.cols()) continue;
      const bool ends = isHit && i + 1 == pieces.size();
      if (!ends && pieces[i].length < reading.least) continue;
      double& value = change.values(x, y);
      const double says = ends ? evidence.hit : evidence.miss;
      if (reading.eachRayCounts)
        value += says;
      else if (reading.lastRayCounts || ends || value == 0)
        value = says;
    }
  }
  if (reading.isAdded) change.values += map.values;
  if (reading.isBounded) change.values = change.values.cwiseMax(-evidence.bound).cwiseMin(evidence.bound);
  return change;
}

/// `got`, but as it should be where rays hardly pass a cell.
inline Eigen::MatrixXd whereClear(const Eigen::MatrixXd& got, const Grid& map, const Eigen::Vector3d& pose,
                                  const Scan& scan, const CellEvidence& evidence) {
  const Eigen::MatrixXd all = mapAfter(map, pose, scan, evidence).values,
                        clear = mapAfter(map, pose, scan, evidence, {.least = .02}).values;
  if (got.rows() != all.rows() || got.cols() != all.cols()) return got;
  return (all.array() == clear.array()).select(got, all);
}

/// The distance of two cells that are x and y cells apart, at least the larger of both.
using CellDistance = std::function<double(double x, double y)>;

/// By all pairs of cells. `isWall` says which log odds are a wall.
inline Grid distancesTo(
    const Grid& map, double reach,
    const CellDistance& apart = [](double x, double y) { return std::sqrt(x * x + y * y); },
    const std::function<bool(double)>& isWall = [](double odds) { return odds > 0; }) {
  Grid distances = map;
  std::vector<Eigen::Vector2d> walls;
  for (Eigen::Index i = 0; i < map.values.rows(); ++i)
    for (Eigen::Index j = 0; j < map.values.cols(); ++j)
      if (isWall(map.values(i, j))) walls.emplace_back(i, j);
  for (Eigen::Index i = 0; i < map.values.rows(); ++i)
    for (Eigen::Index j = 0; j < map.values.cols(); ++j) {
      double& nearest = distances.values(i, j) = reach;
      for (const Eigen::Vector2d& wall : walls) {
        const double x = std::abs(wall[0] - static_cast<double>(i)),
                     y = std::abs(wall[1] - static_cast<double>(j));
        if (map.cell * std::max(x, y) < reach) nearest = std::min(nearest, map.cell * apart(x, y));
      }
    }
  return distances;
}

/// A sum of tents, each as high as its cell, with its foot at the neighbours.
inline double between(const Grid& grid, const Eigen::Vector2d& p, double half = .5) {
  double sum = 0;
  const auto cells = [&](int k) {
    return static_cast<double>(k == 0 ? grid.values.rows() : grid.values.cols());
  };
  Eigen::Vector2d at;
  for (int k = 0; k < 2; ++k)
    at[k] = std::clamp((p[k] - grid.origin[k]) / grid.cell - half, 0., cells(k) - 1);
  for (int i = static_cast<int>(at[0]); i <= static_cast<int>(std::ceil(at[0])); ++i)
    for (int j = static_cast<int>(at[1]); j <= static_cast<int>(std::ceil(at[1])); ++j)
      sum += grid.values(i, j) * (1 - std::abs(at[0] - i)) * (1 - std::abs(at[1] - j));
  return sum;
}

inline double fitOf(const Grid& distances, const Eigen::Vector3d& pose, const Scan& scan, double deviation) {
  double sum = 0;
  for (Eigen::Index k = 0; k < scan.ranges.size(); ++k)
    if (scan.ranges[k] < scan.maxRange)
      sum -= std::pow(between(distances, endOf(pose, scan, k)) / deviation, 2);
  return sum / 2;
}

/// The best pose in a window: all of a grid, then downhill from the five best by a shrinking pattern.
inline Eigen::Vector3d bestIn(const Grid& distances, const Scan& scan, double deviation,
                              const Eigen::Vector3d& guess, const Eigen::Vector2d& window) {
  const Eigen::Vector3d size(window[0], window[0], window[1]);
  std::vector<std::pair<double, Eigen::Vector3d>> tried;
  for (int k = 0; k < 343; ++k) {
    const Eigen::Vector3d share = Eigen::Vector3d(k % 7 - 3, k / 7 % 7 - 3, k / 49 - 3) / 3;
    const Eigen::Vector3d pose = guess + share.cwiseProduct(size);
    tried.emplace_back(fitOf(distances, pose, scan, deviation), pose);
  }
  std::partial_sort(tried.begin(), tried.begin() + 5, tried.end(),
                    [](const auto& a, const auto& b) { return a.first > b.first; });
  for (std::size_t n = 0; n < 5; ++n)
    for (double part = .2; part > .004; part *= .6)
      for (int k = 0; k < 27; ++k) {
        Eigen::Vector3d pose =
            tried[n].second + part * Eigen::Vector3d(k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1).cwiseProduct(size);
        pose = pose.cwiseMax(guess - size).cwiseMin(guess + size);
        const double value = fitOf(distances, pose, scan, deviation);
        if (value > tried[n].first) tried[n] = {value, pose};
      }
  return std::max_element(tried.begin(), tried.begin() + 5,
                          [](const auto& a, const auto& b) { return a.first < b.first; })
      ->second;
}

inline Eigen::Vector3d motionFrom(const Eigen::Vector3d& before, const Eigen::Vector3d& after) {
  const Eigen::Vector2d way = after.head<2>() - before.head<2>();
  const double c = std::cos(before[2]), s = std::sin(before[2]);
  return {c * way.x() + s * way.y(), c * way.y() - s * way.x(),
          std::remainder(after[2] - before[2], 2 * std::acos(-1.))};
}

/// How well the walls of a map are those of the building.
inline double overlapOf(const Grid& map, const Grid& truth) {
  const auto mapOf = [&](const Grid& grid) {
    rex::OccupancyMap cells(60, 60, truth.cell, truth.origin);
    for (int i = 0; i < 60; ++i)
      for (int j = 0; j < 60; ++j) cells.setLogOdds(i, j, grid.values(i, j));
    return cells;
  };
  return rex::compareMaps(mapOf(map), mapOf(truth)).overlap;
}

/// A map of that size with some walls, unknown and free cells, and an origin somewhere.
inline Grid randomGrid(int width, int height, rex::Rng& rng) {
  Grid grid{{rounded(rng.uniform(-3, 1)), rounded(rng.uniform(-3, 1))}, .05 * (3 + rng.index(6)), {}};
  grid.values.resize(width, height);
  for (double& value : grid.values.reshaped()) {
    const double kind = rng.uniform();
    value = kind < .07 ? rounded(rng.uniform(.2, 5)) : kind < .4 ? 0 : rounded(rng.uniform(-5, -.2));
  }
  return grid;
}

/// A point in the middle of a grid, away from borders of cells.
inline Eigen::Vector2d pointIn(const Grid& grid, rex::Rng& rng) {
  const auto along = [&](Eigen::Index cells) {
    return rng.index(static_cast<int>(cells)) + .1 * (1 + rng.index(9)) + .013;
  };
  const double x = along(grid.values.rows()), y = along(grid.values.cols());
  return grid.origin + grid.cell * Eigen::Vector2d(x, y);
}

/// Rays in all directions, from a pose in a small map; some hit nothing. No ray ends near a border. The
/// longest range is rounded as the others are, so that equal numbers look equal.
inline Scan randomScan(const Grid& grid, const Eigen::Vector3d& pose, int rays, rex::Rng& rng) {
  Scan scan{Eigen::VectorXd(rays), Eigen::VectorXd(rays), rounded(5 * grid.cell)};
  for (Eigen::Index k = 0; k < rays; ++k) {
    scan.angles[k] = rounded(rng.uniform(-3, 3));
    for (;;) {
      scan.ranges[k] = rounded(rng.uniform(.3, 1.3) * scan.maxRange);
      if (k % 4 == 1) scan.ranges[k] = scan.maxRange;
      const Eigen::Vector2d end = (endOf(pose, scan, k) - grid.origin) / grid.cell;
      const Eigen::Vector2d share = end.array() - end.array().floor();
      if (scan.ranges[k] >= scan.maxRange || (share.minCoeff() > .05 && share.maxCoeff() < .95)) break;
    }
  }
  return scan;
}
