#include "estimation/occupancy_map.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "base/rng.h"
#include "estimation/scan_weights.h"
#include "geometry/rotation.h"
#include "support/expect_error.h"

namespace rex::occupancy_map_test {

using std::numbers::pi;

// A room of 6 x 4 m with a wall in it and no symmetry.
OccupancyMap room() {
  OccupancyMap map(60, 40, .1, {-1, -2});
  for (int y = 0; y < 40; ++y)
    for (int x = 0; x < 60; ++x) {
      const bool border = x == 0 || y == 0 || x == 59 || y == 39;
      const bool wall = (x == 30 && y < 25) || (y == 30 && x > 40) || (x > 5 && x < 12 && y > 5 && y < 9);
      map.setLogOdds(x, y, border || wall ? 5 : -5);
    }
  return map;
}

RangeScanner scanner(int rays) {
  RangeScanner result{.maxRange = 5};
  for (int i = 0; i < rays; ++i) result.angles.push_back(2 * pi * i / rays);
  return result;
}

// Against steps of a thousandth of a cell.
TEST(OccupancyMap, MeetsCellsInTheirOrder) {
  const OccupancyMap map = room();
  Rng rng(81);
  for (int i = 0; i < 300; ++i) {
    const Eigen::Vector2d p(rng.uniform(-.8, 4.8), rng.uniform(-1.8, 1.8));
    const double angle = i % 10 == 0 ? pi / 2 * rng.index(4) : rng.uniform(-10, 10);
    double walked = 0;
    const auto isFree = [&](double way) {
      const Eigen::Vector2i cell = map.cellAt(p + way * Eigen::Vector2d(std::cos(angle), std::sin(angle)));
      return !map.isOccupied(cell[0], cell[1]);
    };
    while (walked < 3 && isFree(walked)) walked += 1e-4;
    EXPECT_NEAR(map.distanceToOccupied(p, angle, 3), std::min(walked, 3.), 2e-3);
  }
  EXPECT_EQ(map.distanceToOccupied({10, 10}, 0, 3), 3) << "outside, away from the map";
  EXPECT_EQ(map.distanceToOccupied({-.95, 0}, 0, 3), 0) << "within a wall";
}

// From outside, also from afar, a ray meets the same cells as from where it enters.
TEST(OccupancyMap, RaysComeInFromOutside) {
  const OccupancyMap map = room();
  Rng rng(83);
  for (int i = 0; i < 300; ++i) {
    const Eigen::Vector2d inside(rng.uniform(-.9, 4.9), rng.uniform(-1.9, 1.9));
    const double angle = i % 10 == 0 ? pi / 2 * rng.index(4) : rng.uniform(-10, 10);
    const Eigen::Vector2d ahead(std::cos(angle), std::sin(angle));
    double way = 0;
    const auto hit = [&](double at) {
      const Eigen::Vector2i cell = map.cellAt(inside + at * ahead);
      return map.isOccupied(cell[0], cell[1]);
    };
    for (way = -10; way < 10 && !hit(way);) way += 1e-4;
    EXPECT_NEAR(map.distanceToOccupied(inside - 10 * ahead, angle, 100), 10 + way, 2e-3);
    EXPECT_EQ(map.distanceToOccupied(inside - 10 * ahead, angle + pi, 100), 100) << "away from the map";
  }
  for (const double far : {1e6, 1e12, 1e300}) {
    const double met = map.distanceToOccupied({-far, 0}, 0, 2 * far);
    EXPECT_NEAR(met, far < 1e15 ? far - 1 : 2 * far, 1e-3 * far / 1e6)
        << "a room too far away to be aimed at";
    EXPECT_EQ(map.distanceToOccupied({far, 0}, 0, INFINITY), INFINITY);
    EXPECT_EQ(map.distanceToOccupied({far, far}, pi / 2, far), far);
  }
  OccupancyMap strip(5, 1, 1);
  strip.observe({.angles = {0}, .maxRange = 100}, {-50, .5, 0}, Eigen::VectorXd::Constant(1, 52.5));
  EXPECT_TRUE(strip.isOccupied(2, 0));
  EXPECT_LT(strip.logOdds(1, 0), 0);
  EXPECT_EQ(strip.logOdds(3, 0), 0);
}

TEST(OccupancyMap, IsDrawnByScans) {
  const OccupancyMap truth = room();
  OccupancyMap drawn(60, 40, .1, {-1, -2});
  const RangeScanner eye = scanner(180);
  Eigen::VectorXd ranges(180);
  Rng rng(82);
  for (int i = 0; i < 60; ++i) {
    Eigen::Vector3d pose;
    do pose << rng.uniform(-.8, 4.8), rng.uniform(-1.8, 1.8), rng.uniform(-pi, pi);
    while (truth.isOccupied(truth.cellAt(pose.head<2>())[0], truth.cellAt(pose.head<2>())[1]));
    truth.scan(eye, pose, ranges);
    drawn.observe(eye, pose, ranges);
  }
  int known = 0, wrong = 0;
  for (int y = 0; y < 40; ++y)
    for (int x = 0; x < 60; ++x) {
      if (std::abs(drawn.logOdds(x, y)) < 1) continue;
      ++known;
      wrong += drawn.isOccupied(x, y) != truth.isOccupied(x, y);
      EXPECT_LE(drawn.probability(x, y), .999 + 1e-12);
    }
  EXPECT_GT(known, 2000);
  EXPECT_LT(wrong, known / 50);
}

// A cell seen k times occupied and m times free has the odds of Bayes' rule.
TEST(OccupancyMap, OddsMultiply) {
  OccupancyMap map(5, 1, 1);
  const RangeScanner eye{.angles = {0}, .maxRange = 10};
  const Eigen::Vector3d pose(.5, .5, 0);
  map.observe(eye, pose, Eigen::VectorXd::Constant(1, 2.5), {.hit = .8, .miss = .4});
  map.observe(eye, pose, Eigen::VectorXd::Constant(1, 3.5), {.hit = .8, .miss = .4});
  EXPECT_NEAR(map.probability(3, 0), 4. * (2. / 3) / (1 + 4. * 2 / 3), 1e-12) << "once hit, once passed";
  EXPECT_NEAR(map.probability(4, 0), .8, 1e-12);
  EXPECT_NEAR(map.probability(1, 0), 4. / 9 / (1 + 4. / 9), 1e-12) << "passed twice";
}

// Lost at first anywhere in the room, the robot finds itself while it drives.
TEST(OccupancyMap, RobotFindsItselfInIt) {
  const OccupancyMap map = room();
  const RangeScanner eye = scanner(18);
  Eigen::VectorXd ranges(18);
  int found = 0;
  const int runs = 6;
  for (std::uint64_t seed = 0; seed < runs; ++seed) {
    Rng rng(seed);
    const int count = 2000;
    Particles particles{Eigen::MatrixXd(3, count), Eigen::VectorXd::Constant(count, 1. / count)};
    for (int i = 0; i < count; ++i)
      particles.states.col(i) << rng.uniform(-.9, 4.9), rng.uniform(-1.9, 1.9), rng.uniform(-pi, pi);
    ParticleFilter filter(particles, {.resampling = Resampling::kSystematic});
    Eigen::Vector3d pose(3, -1, .3);
    const NonlinearModel drive{.g = [](const Eigen::VectorXd& x) -> Eigen::VectorXd {
                                 return x + Eigen::Vector3d(.08 * std::cos(x[2]), .08 * std::sin(x[2]), .15);
                               },
                               .W = Eigen::Vector3d(1e-4, 1e-4, 4e-4).asDiagonal()};
    for (int t = 0; t < 25; ++t) {
      pose = drive.g(pose) + Eigen::Vector3d(.01, .01, .02).cwiseProduct(rng.normalVector(3));
      map.scan(eye, pose, ranges);
      ranges += .05 * rng.normalVector(18);
      (void)filter.step(motionProposal(drive), scanWeights(map, eye, ranges, {.temper = 3}), rng);
    }
    found += (sampleMoments(filter.particles()).mean - pose).head<2>().norm() < .15;
  }
  EXPECT_GE(found, 5);
}

TEST(OccupancyMap, SaysWhatIsWrong) {
  EXPECT_REX_ERROR(OccupancyMap(0, 4, 1), "occupancy map: found 0 x 4 cells, wanted 1 to 1e+08 cells");
  EXPECT_REX_ERROR(OccupancyMap(100000, 100000, 1), "found 100000 x 100000 cells");
  EXPECT_REX_ERROR(OccupancyMap(1, 1, 0),
                   "occupancy map: size of a cell: found 0 m, wanted a positive, finite number of metres");
  EXPECT_REX_ERROR(OccupancyMap(1, 1, 1, {INFINITY, 0}), "occupancy map: origin: number 0: found inf");
  OccupancyMap map(4, 4, 1);
  const RangeScanner eye{.angles = {0, 1}, .maxRange = 5};
  const Eigen::Vector3d pose(1, 1, 0);
  EXPECT_REX_ERROR(map.observe(eye, pose, Eigen::Vector3d(1, 1, 1)),
                   "ranges: found a vector of size 3, wanted size 2");
  EXPECT_REX_ERROR(map.observe(eye, pose, Eigen::Vector2d(1, -1)),
                   "ranges: number 1: found -1, wanted a finite number, 0 or more");
  EXPECT_EQ(map.logOdds(1, 1), 0) << "nothing of a wrong scan is in the map";
  EXPECT_REX_ERROR(map.cellAt({0, std::nan("")}), "point: number 1: found nan");
  EXPECT_REX_ERROR(map.distanceToOccupied({INFINITY, 0}, 0, 1), "start of the ray: number 0: found inf");
  EXPECT_REX_ERROR(map.distanceToOccupied({0, 0}, INFINITY, 1), "angle of the ray: found inf");
  EXPECT_REX_ERROR(map.distanceToOccupied({0, 0}, 0, std::nan("")), "largest range: found nan");
  EXPECT_REX_ERROR(map.distanceToOccupied({0, 0}, 0, -1),
                   "largest range: found -1 m, wanted a number of metres, 0 or more, or infinity");
  Eigen::VectorXd ranges(2);
  EXPECT_REX_ERROR(map.scan(eye, {0, std::nan(""), 0}, ranges), "pose of the scanner: number 1: found nan");
  EXPECT_REX_ERROR(map.scan({.angles = {0, INFINITY}}, pose, ranges), "scanner: angle 1: found inf");
  for (const double maxRange : {0., double{INFINITY}}) {
    const RangeScanner wrong{.angles = {0, 1}, .maxRange = maxRange};
    EXPECT_REX_ERROR(map.scan(wrong, pose, ranges), "scanner: largest range: found");
    EXPECT_REX_ERROR(map.observe(wrong, pose, Eigen::Vector2d(1, 1)), "scanner: largest range: found");
    EXPECT_REX_ERROR(scanWeights(map, wrong, Eigen::Vector2d(1, 1)),
                     "wanted a positive, finite number of metres");
  }
  EXPECT_REX_ERROR(scanWeights(map, eye, Eigen::Vector2d(1, -1)), "ranges: number 1: found -1");
  EXPECT_REX_ERROR(map.observe(eye, pose, Eigen::Vector2d(1, std::nan(""))), "ranges: number 1: found nan");
  EXPECT_REX_ERROR(map.observe(eye, {0, 0, INFINITY}, Eigen::Vector2d(1, 1)),
                   "pose of the scanner: number 2: found inf");
  EXPECT_REX_ERROR(map.observe(eye, pose, Eigen::Vector2d(1, 1), {.hit = .4}),
                   "evidence of rays: found miss 0.3, hit 0.4");
  EXPECT_REX_ERROR(scanWeights(map, eye, Eigen::Vector2d(1, 1), {.deviation = 0}),
                   "beam model: deviation: found 0 m, wanted a positive, finite number of metres");
  EXPECT_REX_ERROR(scanWeights(map, eye, Eigen::Vector2d(1, 1), {.bell = 1}),
                   "beam model: shares: found bell 1, none 0.05");
  EXPECT_REX_ERROR(scanWeights(map, eye, Eigen::Vector2d(1, 1), {.temper = 0}),
                   "beam model: temper: found 0");
  EXPECT_REX_ERROR(scanWeights(map, eye, Eigen::VectorXd::Ones(3)),
                   "ranges: found a vector of size 3, wanted size 2");
}

}  // namespace rex::occupancy_map_test
