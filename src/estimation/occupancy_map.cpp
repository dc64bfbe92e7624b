#include "estimation/occupancy_map.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <fmt/format.h>

#include "base/error.h"
#include "base/require.h"
#include "estimation/range_scan_internal.h"

namespace rex {
namespace {

constexpr double kMostCells = 1e8;

double logOddsOf(double probability) { return std::log(probability / (1 - probability)); }

// The part of a ray, in metres along it, within the map's box; empty unless first < last.
struct Stretch {
  double first = 0, last = std::numeric_limits<double>::infinity();
};
Stretch within(const Eigen::Vector2d& start, const Eigen::Vector2d& direction, const OccupancyMap& map) {
  Stretch stretch;
  for (int k = 0; k < 2; ++k) {
    const double size = k == 0 ? map.width() : map.height();
    if (direction[k] == 0) {
      if (!(0 <= start[k] && start[k] < size)) return {1, 0};
      continue;
    }
    const double metres = map.cellSize() / direction[k];
    const double a = -start[k] * metres, b = (size - start[k]) * metres;
    stretch.first = std::max(stretch.first, std::min(a, b));
    stretch.last = std::min(stretch.last, std::max(a, b));
  }
  return stretch;
}

// Walks the cells of the map along a ray; visit(x, y, entered, left) gets where the ray enters and leaves
// each cell, in metres, and returns whether to go on. The part before the map is skipped, so that cells are
// small numbers however far away the ray starts.
template <class Visit>
void walk(const OccupancyMap& map, const Eigen::Vector2d& p, double angle, double length,
          const Visit& visit) {
  const double inverse = 1 / map.cellSize();
  const Eigen::Vector2d start = (p - map.origin()) * inverse, direction(std::cos(angle), std::sin(angle));
  const Stretch stretch = within(start, direction, map);
  if (!(stretch.first < stretch.last && stretch.first < length)) return;
  const int sizes[2] = {map.width(), map.height()};
  int cell[2], step[2];
  double next[2], gap[2];  // metres to the next border across each axis, and between borders
  for (int k = 0; k < 2; ++k) {
    const double at = start[k] + direction[k] * (stretch.first * inverse);
    cell[k] = static_cast<int>(std::clamp(std::floor(at), 0., sizes[k] - 1.));
    step[k] = direction[k] < 0 ? -1 : 1;
    gap[k] = map.cellSize() / std::max(std::abs(direction[k]), 1e-300);
    const double share = direction[k] < 0 ? at - cell[k] : cell[k] + 1 - at;
    next[k] = stretch.first + share * gap[k];
  }
  for (double entered = stretch.first; entered < length;) {
    const int axis = next[0] < next[1] ? 0 : 1;
    const double left = next[axis];
    if (!visit(cell[0], cell[1], entered, left)) return;
    cell[axis] += step[axis];
    if (cell[axis] < 0 || cell[axis] >= sizes[axis]) return;
    next[axis] += gap[axis];
    entered = left;
  }
}

double lengthOfRay(const OccupancyMap& map, const Eigen::Vector2d& p, double angle, double maxRange) {
  double distance = maxRange;
  walk(map, p, angle, maxRange, [&](int x, int y, double entered, double) {
    if (!map.isOccupied(x, y)) return true;
    distance = entered;
    return false;
  });
  return distance;
}

void requireEvidence(const RayEvidence& evidence) {
  if (0 < evidence.miss && evidence.miss < 0.5 && 0.5 < evidence.hit && evidence.hit < 1 &&
      0.5 < evidence.bound && evidence.bound < 1)
    return;
  throw Error(
      {.what = "evidence of rays",
       .found = fmt::format("miss {:g}, hit {:g}, bound {:g}", evidence.miss, evidence.hit, evidence.bound),
       .wanted = "0 < miss < 0.5 < hit < 1 and 0.5 < bound < 1"});
}

}  // namespace

void internal::requireScanner(const RangeScanner& scanner) {
  requirePositive("scanner: largest range", scanner.maxRange, kMetres);
  for (std::size_t i = 0; i < scanner.angles.size(); ++i)
    if (!std::isfinite(scanner.angles[i]))
      requireFinite(fmt::format("scanner: angle {}", i), scanner.angles[i]);
}

void internal::requireRanges(const RangeScanner& scanner, const VectorArg& ranges) {
  requireScanner(scanner);
  requireSize("ranges", ranges.size(), static_cast<long>(scanner.angles.size()));
  requireNotNegative("ranges", ranges);
}

OccupancyMap::OccupancyMap(int width, int height, double cellSize, const Eigen::Vector2d& origin)
    : width_(width), height_(height), cellSize_(cellSize), origin_(origin) {
  if (width < 1 || height < 1 || static_cast<double>(width) * height > kMostCells)
    throw Error({.what = "occupancy map",
                 .found = fmt::format("{} x {} cells", width, height),
                 .wanted = fmt::format("1 to {:g} cells", kMostCells)});
  requirePositive("occupancy map: size of a cell", cellSize, kMetres);
  requireFinite("occupancy map: origin", origin);
  cells_.assign(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), 0);
}

double OccupancyMap::probability(int x, int y) const { return 1 / (1 + std::exp(-logOdds(x, y))); }

Eigen::Vector2i OccupancyMap::cellAt(const Eigen::Vector2d& p) const {
  requireFinite("point", p);
  const Eigen::Vector2d share = ((p - origin_) / cellSize_).array().floor();
  return share.cwiseMax(-1).cwiseMin(std::max(width_, height_)).cast<int>();
}

double OccupancyMap::distanceToOccupied(const Eigen::Vector2d& p, double angle, double maxRange) const {
  requireFinite("start of the ray", p);
  requireFinite("angle of the ray", angle);
  requireNotNegativeOrInfinite("largest range", maxRange, kMetres);
  return lengthOfRay(*this, p, angle, maxRange);
}

void OccupancyMap::scan(const RangeScanner& scanner, const Eigen::Vector3d& pose,
                        Eigen::Ref<Eigen::VectorXd> ranges) const {
  internal::requireScanner(scanner);
  requireSize("ranges", ranges.size(), static_cast<long>(scanner.angles.size()));
  requireFinite("pose of the scanner", pose);
  for (std::size_t i = 0; i < scanner.angles.size(); ++i)
    ranges[static_cast<Eigen::Index>(i)] =
        lengthOfRay(*this, pose.head<2>(), pose[2] + scanner.angles[i], scanner.maxRange);
}

void OccupancyMap::observe(const RangeScanner& scanner, const Eigen::Vector3d& pose, const VectorArg& ranges,
                           const RayEvidence& evidence) {
  internal::requireRanges(scanner, ranges);
  requireFinite("pose of the scanner", pose);
  requireEvidence(evidence);
  const double hit = logOddsOf(evidence.hit), miss = logOddsOf(evidence.miss),
               bound = logOddsOf(evidence.bound);
  const auto add = [&](int x, int y, double value) {
    setLogOdds(x, y, std::clamp(logOdds(x, y) + value, -bound, bound));
  };
  for (std::size_t i = 0; i < scanner.angles.size(); ++i) {
    const double range = ranges[static_cast<Eigen::Index>(i)];
    const bool isHit = range < scanner.maxRange;
    // The end lies on the border of the cell that stopped the ray: a hair beyond.
    const double end = std::min(range, scanner.maxRange) + (isHit ? 1e-6 * cellSize_ : 0);
    walk(*this, pose.head<2>(), pose[2] + scanner.angles[i], end, [&](int x, int y, double, double left) {
      add(x, y, isHit && left >= end ? hit : miss);
      return true;
    });
  }
}

namespace {

// Marks the cells for which `isMarked` holds somewhere within `reach`.
template <class IsMarked>
std::vector<bool> dilated(const OccupancyMap& map, int reach, const IsMarked& isMarked) {
  std::vector<bool> marks(static_cast<std::size_t>(map.width()) * static_cast<std::size_t>(map.height()));
  for (int y = 0; y < map.height(); ++y)
    for (int x = 0; x < map.width(); ++x) {
      if (!isMarked(x, y)) continue;
      for (int v = std::max(y - reach, 0); v <= std::min(y + reach, map.height() - 1); ++v)
        for (int u = std::max(x - reach, 0); u <= std::min(x + reach, map.width() - 1); ++u)
          marks[static_cast<std::size_t>(v) * static_cast<std::size_t>(map.width()) +
                static_cast<std::size_t>(u)] = true;
    }
  return marks;
}

}  // namespace

MapAgreement compareMaps(const OccupancyMap& map, const OccupancyMap& truth, int reach) {
  requireCount("reach of the comparison", reach, 0);
  if (map.width() != truth.width() || map.height() != truth.height())
    throw Error({.what = "maps to compare",
                 .found = fmt::format("{} x {} and {} x {} cells", map.width(), map.height(), truth.width(),
                                      truth.height()),
                 .wanted = "the same size"});
  const auto isOccupied = [&](int x, int y) { return map.isOccupied(x, y); };
  const auto isWall = [&](int x, int y) { return truth.isOccupied(x, y); };
  const std::vector<bool> nearWall = dilated(map, reach, isWall), nearHit = dilated(map, reach, isOccupied);
  int occupied = 0, right = 0, walls = 0, found = 0;
  for (int y = 0, cell = 0; y < map.height(); ++y)
    for (int x = 0; x < map.width(); ++x, ++cell) {
      const std::size_t i = static_cast<std::size_t>(cell);
      occupied += isOccupied(x, y);
      right += isOccupied(x, y) && nearWall[i];
      const bool isSeenWall = isWall(x, y) && map.logOdds(x, y) != 0;
      walls += isSeenWall;
      found += isSeenWall && nearHit[i];
    }
  MapAgreement result;
  if (right == 0 || found == 0) return result;
  result.precision = static_cast<double>(right) / occupied;
  result.recall = static_cast<double>(found) / walls;
  result.overlap = 2 * result.precision * result.recall / (result.precision + result.recall);
  return result;
}

}  // namespace rex
