#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>

#include "base/rng.h"
#include "estimation/building.h"
#include "estimation/scan_weights.h"
#include "support/expect_error.h"

namespace rex::scan_lookup_test {

using std::numbers::pi;

// A room of 3 x 2 m without symmetry; cells of 10 cm, none of them unknown.
OccupancyMap room() {
  Building building;
  building.addBox(0, 0, 3, 2);
  building.addBox(1.9, .3, .5, .6);
  OccupancyMap map(33, 23, .1, {-.15, -.15});
  rasterize(building, map);
  return map;
}

RangeScanner scanner() { return {.angles = {0, .7, 1.5, 2.4, 3.3, 4.1, 5.2}, .maxRange = 2.5}; }

// The density of the header, from scans at the centres of all cells.
TEST(ScanLookup, AgreesWithScansOfTheMap) {
  const OccupancyMap map = room();
  const ScanLookup lookup(map, scanner(), .25, 12);
  const StateGrid& grid = lookup.grid();
  EXPECT_EQ(grid.counts, Eigen::Vector3i(14, 10, 12));
  Eigen::VectorXd read(7), expected(7);
  map.scan(scanner(), {.8, 1.3, .4}, read);
  read[2] = scanner().maxRange;  // far from what any pose expects
  const double deviation = .3, temper = 2;
  const StateDensity given = lookup.given(read, deviation, temper), anywhere = lookup.anywhere();
  Eigen::VectorXd likelihoods = Eigen::VectorXd::Zero(grid.cells());
  int poses = 0;
  for (int i = 0; i < grid.cells(); ++i) {
    const Eigen::Vector3d pose = grid.center(i);
    const Eigen::Vector2i at = map.cellAt(pose.head<2>());
    if (!map.contains(at.x(), at.y()) || map.isOccupied(at.x(), at.y())) continue;
    ++poses;
    map.scan(scanner(), pose, expected);
    double sum = 0;
    for (int k = 0; k < 7; ++k) sum += std::min(std::pow((read[k] - expected[k]) / deviation, 2), 9.);
    likelihoods[i] = std::exp(-.5 * sum / temper);
  }
  const double volume = .25 * .25 * 2 * pi / 12, total = likelihoods.sum() * volume;
  int blocked = 0;
  for (int i = 0; i < grid.cells(); ++i) {
    const Eigen::VectorXd pose = grid.center(i);
    if (likelihoods[i] > 0) {
      EXPECT_NEAR(given.logDensity(pose), std::log(likelihoods[i] / total), 1e-4) << pose.transpose();
      EXPECT_NEAR(anywhere.logDensity(pose), -std::log(poses * volume), 1e-9);
    } else {
      EXPECT_EQ(given.logDensity(pose), -std::numeric_limits<double>::infinity());
      EXPECT_EQ(anywhere.logDensity(pose), -std::numeric_limits<double>::infinity());
      ++blocked;
    }
  }
  EXPECT_GT(blocked, 100);
}

// Most of what is drawn lies around the pose of the scan, which the uniform density rarely meets.
TEST(ScanLookup, DrawsWhereTheScanFits) {
  const OccupancyMap map = room();
  const ScanLookup lookup(map, scanner(), .2, 24);
  const Eigen::Vector3d pose(.8, 1.3, .4);
  Eigen::VectorXd read(7);
  map.scan(scanner(), pose, read);
  Rng rng(41);
  const auto near = [&](const StateDensity& density) {
    int count = 0;
    for (int i = 0; i < 400; ++i) {
      const Eigen::Vector3d error = density.draw(rng) - pose;
      count += error.head<2>().norm() < .3 && std::abs(std::sin(error[2] / 2)) < .2;
    }
    return count;
  };
  EXPECT_GT(near(lookup.given(read, .1, 1)), 300);
  EXPECT_LT(near(lookup.anywhere()), 20);
}

TEST(ScanLookup, SaysWhatIsWrong) {
  const OccupancyMap map = room(), unknown(10, 10, .1);
  EXPECT_REX_ERROR(ScanLookup(map, scanner(), 0), "lookup of scans: size of a cell: found 0 m");
  EXPECT_REX_ERROR(ScanLookup(map, scanner(), .4, 0), "lookup of scans: headings: found 0");
  EXPECT_REX_ERROR(ScanLookup(map, scanner(), 1e-3), "lookup of scans: poses: found 1.82");
  EXPECT_REX_ERROR(ScanLookup(unknown, scanner()),
                   "lookup of scans: found no free cell of the map at steps of 0.4 m, wanted one or more");
  EXPECT_REX_ERROR(ScanLookup(map, {.angles = {0}, .maxRange = 0}), "scanner: largest range");
  const ScanLookup lookup(map, scanner(), .5, 4);
  EXPECT_REX_ERROR(lookup.given(Eigen::VectorXd::Ones(3)), "ranges: found a vector of size 3");
  EXPECT_REX_ERROR(lookup.given(-Eigen::VectorXd::Ones(7)), "ranges: number 0: found -1");
  EXPECT_REX_ERROR(lookup.given(Eigen::VectorXd::Ones(7), 0), "lookup of scans: deviation: found 0 m");
  EXPECT_REX_ERROR(lookup.given(Eigen::VectorXd::Ones(7), 1, 0), "lookup of scans: temper: found 0");
}

}  // namespace rex::scan_lookup_test
