#include "estimation/occupancy_map.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "base/error.h"
#include "base/require_finite.h"

namespace rex {
namespace {

constexpr double kMostCells = 1e8;

double logOddsOf(double probability) { return std::log(probability / (1 - probability)); }

// Walks the cells along a ray; visit(x, y, entered, left) gets where the ray enters and leaves each, in
// metres, and says whether to go on.
template <class Visit>
void walk(const OccupancyMap& map, const Eigen::Vector2d& p, double angle, double length,
          const Visit& visit) {
  const double inverse = 1 / map.cellSize();
  const Eigen::Vector2d start = (p - map.origin()) * inverse, direction(std::cos(angle), std::sin(angle));
  int cell[2], step[2];
  double next[2], gap[2];  // metres to the next border across each axis, and between borders
  for (int k = 0; k < 2; ++k) {
    cell[k] = static_cast<int>(std::floor(start[k]));
    step[k] = direction[k] < 0 ? -1 : 1;
    gap[k] = map.cellSize() / std::max(std::abs(direction[k]), 1e-300);
    const double share = direction[k] < 0 ? start[k] - cell[k] : cell[k] + 1 - start[k];
    next[k] = share * gap[k];
  }
  for (double entered = 0; entered < length;) {
    const int axis = next[0] < next[1] ? 0 : 1;
    const double left = next[axis];
    if (!visit(cell[0], cell[1], entered, left)) return;
    // Beyond the map in this direction nothing follows.
    const int size = axis == 0 ? map.width() : map.height();
    if (step[axis] < 0 ? cell[axis] < 0 : cell[axis] >= size) return;
    cell[axis] += step[axis];
    next[axis] += gap[axis];
    entered = left;
  }
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

OccupancyMap::OccupancyMap(int width, int height, double cellSize, const Eigen::Vector2d& origin)
    : width_(width), height_(height), cellSize_(cellSize), origin_(origin) {
  if (width < 1 || height < 1 || static_cast<double>(width) * height > kMostCells)
    throw Error({.what = "occupancy map",
                 .found = fmt::format("{} x {} cells", width, height),
                 .wanted = fmt::format("1 to {:g} cells", kMostCells)});
  if (!(cellSize > 0) || !std::isfinite(cellSize))
    throw Error({.what = "occupancy map: size of a cell",
                 .found = fmt::format("{:g}", cellSize),
                 .wanted = "a positive number"});
  requireFinite("occupancy map: origin", origin);
  cells_.assign(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), 0);
}

double OccupancyMap::probability(int x, int y) const { return 1 / (1 + std::exp(-logOdds(x, y))); }

Eigen::Vector2i OccupancyMap::cellAt(const Eigen::Vector2d& p) const {
  const Eigen::Vector2d share = ((p - origin_) / cellSize_).array().floor();
  return share.cwiseMax(-1).cwiseMin(std::max(width_, height_)).cast<int>();
}

double OccupancyMap::distanceToOccupied(const Eigen::Vector2d& p, double angle, double maxRange) const {
  double distance = maxRange;
  walk(*this, p, angle, maxRange, [&](int x, int y, double entered, double) {
    if (!isOccupied(x, y)) return true;
    distance = entered;
    return false;
  });
  return distance;
}

void OccupancyMap::scan(const RangeScanner& scanner, const Eigen::Vector3d& pose,
                        Eigen::Ref<Eigen::VectorXd> ranges) const {
  requireSize("ranges", ranges.size(), static_cast<long>(scanner.angles.size()));
  for (std::size_t i = 0; i < scanner.angles.size(); ++i)
    ranges[static_cast<Eigen::Index>(i)] =
        distanceToOccupied(pose.head<2>(), pose[2] + scanner.angles[i], scanner.maxRange);
}

void OccupancyMap::observe(const RangeScanner& scanner, const Eigen::Vector3d& pose, const VectorArg& ranges,
                           const RayEvidence& evidence) {
  requireSize("ranges", ranges.size(), static_cast<long>(scanner.angles.size()));
  requireFinite("pose of the scanner", pose);
  requireFinite("ranges", ranges);
  requireEvidence(evidence);
  const double hit = logOddsOf(evidence.hit), miss = logOddsOf(evidence.miss),
               bound = logOddsOf(evidence.bound);
  const auto add = [&](int x, int y, double value) {
    if (contains(x, y)) setLogOdds(x, y, std::clamp(logOdds(x, y) + value, -bound, bound));
  };
  for (std::size_t i = 0; i < scanner.angles.size(); ++i) {
    const double range = ranges[static_cast<Eigen::Index>(i)];
    if (range < 0)
      throw Error({.what = fmt::format("ranges: number {}", i),
                   .found = fmt::format("{:g}", range),
                   .wanted = "zero or more"});
    const bool isHit = range < scanner.maxRange;
    // The end lies on the border of the cell that stopped the ray: a hair beyond.
    const double end = std::min(range, scanner.maxRange) + (isHit ? 1e-6 * cellSize_ : 0);
    walk(*this, pose.head<2>(), pose[2] + scanner.angles[i], end, [&](int x, int y, double, double left) {
      add(x, y, isHit && left >= end ? hit : miss);
      return true;
    });
  }
}

}  // namespace rex
