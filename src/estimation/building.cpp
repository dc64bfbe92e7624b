#include "estimation/building.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/require.h"
#include "base/rng.h"
#include "estimation/range_scan_internal.h"

namespace rex {
namespace {

constexpr double kSure = 5;  // log odds

// Whether a segment from a by d meets the square of half width h around the origin: no axis separates them.
bool meetsSquare(const Eigen::Vector2d& a, const Eigen::Vector2d& d, double h) {
  for (int k = 0; k < 2; ++k)
    if (std::min(a[k], a[k] + d[k]) > h || std::max(a[k], a[k] + d[k]) < -h) return false;
  return std::abs(a.x() * d.y() - a.y() * d.x()) <= h * d.cwiseAbs().sum();
}

}  // namespace

void Building::addBox(double x, double y, double width, double height) {
  walls.insert(walls.end(), {{x, y, x + width, y},
                             {x + width, y, x + width, y + height},
                             {x + width, y + height, x, y + height},
                             {x, y + height, x, y}});
}

double distanceToWall(const Building& building, const Eigen::Vector2d& p, double angle, double maxRange) {
  const Eigen::Vector2d d(std::cos(angle), std::sin(angle));
  double nearest = maxRange;
  for (const Eigen::Vector4d& wall : building.walls) {
    const Eigen::Vector2d a = wall.head<2>() - p, w = wall.tail<2>() - wall.head<2>();
    const double across = d.x() * w.y() - d.y() * w.x();
    if (std::abs(across) < 1e-12) continue;
    const double t = (a.x() * w.y() - a.y() * w.x()) / across, s = (a.x() * d.y() - a.y() * d.x()) / across;
    if (t > 0 && s >= 0 && s <= 1) nearest = std::min(nearest, t);
  }
  return nearest;
}

Eigen::VectorXd noisyRanges(const Building& building, const RangeScanner& scanner,
                            const Eigen::Vector3d& pose, double deviation, Rng& rng) {
  internal::requireScanner(scanner);
  requireFinite("pose of the scanner", pose);
  requireNotNegative("deviation of ranges", deviation, kMetres);
  Eigen::VectorXd ranges(static_cast<Eigen::Index>(scanner.angles.size()));
  for (Eigen::Index i = 0; i < ranges.size(); ++i) {
    const double angle = pose[2] + scanner.angles[static_cast<std::size_t>(i)];
    const double range = distanceToWall(building, pose.head<2>(), angle, scanner.maxRange);
    ranges[i] = range;
    if (range < scanner.maxRange)  // a wall is never read as none
      ranges[i] = std::clamp(range + deviation * rng.normal(), 0., std::nextafter(scanner.maxRange, 0.));
  }
  return ranges;
}

void rasterize(const Building& building, OccupancyMap& map) {
  const double half = 0.5 * map.cellSize();
  for (int y = 0; y < map.height(); ++y)
    for (int x = 0; x < map.width(); ++x) {
      const Eigen::Vector2d center = map.origin() + map.cellSize() * Eigen::Vector2d(x + 0.5, y + 0.5);
      const bool isWall = std::ranges::any_of(building.walls, [&](const Eigen::Vector4d& wall) {
        return meetsSquare(wall.head<2>() - center, wall.tail<2>() - wall.head<2>(), half);
      });
      map.setLogOdds(x, y, isWall ? kSure : -kSure);
    }
}

Building officeBuilding() {
  Building office;
  office.addBox(0, 0, 24, 16);
  office.addBox(8, 6, 8, 4);
  office.walls.insert(office.walls.end(), {// the corridor's other side, with doors
                                           {6, 0, 6, 5.2},
                                           {6, 6.4, 6, 9.6},
                                           {6, 10.8, 6, 16},
                                           {18, 0, 18, 7},
                                           {18, 8.2, 18, 16},
                                           {6, 4, 8.4, 4},
                                           {9.6, 4, 14, 4},
                                           {15.2, 4, 18, 4},
                                           {6, 12, 9.5, 12},
                                           {10.7, 12, 15, 12},
                                           {16.2, 12, 18, 12},
                                           // between rooms
                                           {11.5, 0, 11.5, 4},
                                           {13, 12, 13, 16},
                                           {0, 8, 6, 8},
                                           // cut corners
                                           {0, 14, 2, 16},
                                           {21.5, 16, 24, 13.5}});
  for (const auto& [x, y, width, height] : {std::array{1., 1., 1.6, 0.8},
                                            {3.4, 6.2, 1., 1.},
                                            {0.6, 10.4, 0.8, 2.},
                                            {7.4, 1.2, 1.4, 0.7},
                                            {13.5, 0.6, 0.8, 1.8},
                                            {7., 14.2, 1.5, 0.8},
                                            {15.4, 14., 1., 1.},
                                            {20., 3.6, 0.8, 0.8},
                                            {20., 11.2, 0.8, 0.8},
                                            {22.6, 7., 0.9, 2.2},
                                            {10.4, 5.6, 1.2, 0.4},
                                            {16., 8.4, 0.4, 1.1},
                                            {12., 11.6, 1.5, 0.4}})
    office.addBox(x, y, width, height);
  return office;
}

std::vector<Eigen::Vector2d> officeWalk() {
  return {{7, 5},      {17, 5},    {17, 7.6}, {19.5, 7.6}, {21.4, 9.4}, {21.4, 5.2},
          {19.5, 7.6}, {17, 7.6},  {17, 11},  {10.1, 11},  {10.1, 14},  {11.6, 14},
          {10.1, 13},  {10.1, 11}, {7, 11},   {7, 5},      {9.5, 4.8},  {13, 5}};
}

OccupancyMap emptyOffice(double cellSize) {
  // Half a cell beyond a whole number of cells.
  const double margin = cellSize * (std::floor(0.5 / cellSize) + 0.5);
  const auto cells = [&](double metres) {
    return static_cast<int>(std::ceil((metres + 2 * margin) / cellSize));
  };
  return {cells(24), cells(16), cellSize, {-margin, -margin}};
}

}  // namespace rex
