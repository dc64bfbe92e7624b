#include "estimation/grid_slam.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "base/rng.h"
#include "estimation/occupancy_map.h"
#include "estimation/scan_walk.h"
#include "geometry/rotation.h"
#include "support/expect_error.h"
#include "support/rounds.h"

namespace rex::grid_slam_test {

using std::numbers::pi;

RangeScanner scannerOf(int rays, double maxRange) {
  RangeScanner scanner{.maxRange = maxRange};
  for (int i = 0; i < rays; ++i) scanner.angles.push_back(2 * pi * i / rays);
  return scanner;
}

struct Outcome {
  double overlap = 0, error = 0, reckoned = 0;  // of the map, of the path and of odometry alone, metres
};

// Once around the corridor of the office and into two rooms.
Outcome mapOffice(std::uint64_t seed, bool matchScans) {
  Rng rng(seed);
  const RangeScanner scanner = scannerOf(120, 8);
  const Eigen::Vector3d deviations(.03, .03, .02);
  const ScanWalk walk =
      measured(officeBuilding(), posesAlong(officeWalk(), .5, .5), scanner, {.odometry = deviations}, rng);
  OccupancyMap truth(251, 171, .1, {-.55, -.55});
  GridSlam slam(walk.truth.col(0), truth, scanner, walk.ranges.col(0),
                {.particles = 15, .matchScans = matchScans});
  Outcome outcome;
  const double poses = static_cast<double>(walk.truth.cols());
  Eigen::Vector3d reckoned = walk.truth.col(0);
  for (Eigen::Index k = 1; k < walk.truth.cols(); ++k) {
    (void)slam.step(odometryTransition(walk.odometry.col(k), deviations), walk.ranges.col(k), rng);
    reckoned = movedPose(reckoned, walk.odometry.col(k));
    outcome.reckoned += (reckoned - walk.truth.col(k)).head<2>().norm() / poses;
  }
  rasterize(officeBuilding(), truth);
  const int best = slam.likeliest();
  outcome.overlap = compareMaps(slam.map(best), truth).overlap;
  outcome.error = (slam.path(best) - walk.truth).topRows<2>().colwise().norm().mean();
  return outcome;
}

// Walls of the map within a cell of true ones and the reverse, with scan matching. Odometry alone is off by
// decimetres, and particles drawn from it lose the map.
TEST(GridSlam, MapsABuildingWithALoop) {
  const int seeds = rounds(2, 20);
  double matched = 0, plain = 0, error = 0, reckoned = 0;
  for (int seed = 0; seed < seeds; ++seed) {
    const Outcome one = mapOffice(static_cast<std::uint64_t>(seed), true);
    EXPECT_GE(one.overlap, .95) << "seed " << seed;
    matched += one.overlap / seeds;
    error += one.error / seeds;
    reckoned += one.reckoned / seeds;
    plain += mapOffice(static_cast<std::uint64_t>(seed), false).overlap / seeds;
  }
  RecordProperty("overlap", std::to_string(matched));
  RecordProperty("plain", std::to_string(plain));
  EXPECT_LT(plain, matched - .1);
  EXPECT_LT(error, .25 * reckoned);
}

// A box with a step, so that all directions are seen.
Building box() {
  Building building;
  building.addBox(0, 0, 6, 4);
  building.addBox(4.5, 2.5, 1.5, 1.5);
  return building;
}

struct Step {
  Eigen::Vector3d error;  // of the poses after one motion, on average
  Eigen::Vector3d spread;
};
Step oneStep(bool matchScans, double deviation, int particles, Rng& rng) {
  const RangeScanner scanner = scannerOf(180, 8);
  Eigen::Matrix3Xd poses(3, 2);
  poses << 2, 2.3, 2, 2.1, .4, .6;
  const ScanWalk walk =
      measured(box(), poses, scanner, {.odometry = Eigen::Vector3d::Constant(deviation), .range = .01}, rng);
  GridSlam slam(poses.col(0), OccupancyMap(71, 51, .1, {-.55, -.55}), scanner, walk.ranges.col(0),
                {.particles = particles, .matchScans = matchScans, .threshold = 0, .temper = 1});
  (void)slam.step(odometryTransition(walk.odometry.col(1), Eigen::Vector3d::Constant(deviation)),
                  walk.ranges.col(1), rng);
  const Eigen::Matrix3Xd errors = slam.poses().colwise() - poses.col(1);
  const Eigen::Vector3d mean = errors * slam.weights();
  return {mean, ((errors.colwise() - mean).array().square().matrix() * slam.weights()).cwiseSqrt()};
}

// One step by both proposals estimates the same pose: importance weights make up for where poses are drawn.
TEST(GridSlam, ProposalDoesNotChangeThePosterior) {
  for (int seed = 0; seed < 2; ++seed) {
    Rng a(static_cast<std::uint64_t>(seed)), b(static_cast<std::uint64_t>(seed));
    const Step matched = oneStep(true, .01, 200, a), plain = oneStep(false, .01, 2000, b);
    for (int k = 0; k < 3; ++k) {
      EXPECT_NEAR(matched.error[k], plain.error[k], .5 * plain.spread[k]) << "seed " << seed << ", " << k;
      EXPECT_NEAR(matched.spread[k], plain.spread[k], .3 * plain.spread[k]) << "seed " << seed << ", " << k;
      EXPECT_LT(plain.spread[k], .009) << "the scan says more than the motion";
    }
  }
}

TEST(GridSlam, SameSeedSameMap) {
  Rng a(5), b(5);
  EXPECT_EQ(oneStep(true, .03, 5, a).error, oneStep(true, .03, 5, b).error);
}

TEST(GridSlam, KeepsPathsAndMapsTogether) {
  Rng rng(6);
  const RangeScanner scanner = scannerOf(60, 8);
  const Eigen::Matrix3Xd poses = posesAlong({{1, 1}, {3.5, 1.2}, {3.5, 3}}, .5, .8);
  const ScanWalk walk = measured(box(), poses, scanner, {}, rng);
  const OccupancyMap empty(71, 51, .1, {-.55, -.55});
  GridSlam slam(poses.col(0), empty, scanner, walk.ranges.col(0), {.particles = 8, .threshold = 1});
  bool isResampled = false;
  for (Eigen::Index k = 1; k < poses.cols(); ++k) {
    const GridSlamStep step =
        slam.step(odometryTransition(walk.odometry.col(k), {.03, .03, .02}), walk.ranges.col(k), rng);
    isResampled |= step.resampled;
    EXPECT_GE(step.effectiveSize, 1);
    EXPECT_NEAR(slam.weights().sum(), 1, 1e-12);
  }
  EXPECT_TRUE(isResampled);
  for (int i = 0; i < 8; ++i) {  // the map is what the scans draw along the path
    const Eigen::Matrix3Xd path = slam.path(i);
    ASSERT_EQ(path.cols(), poses.cols());
    EXPECT_EQ(path.rightCols<1>(), slam.poses().col(i));
    OccupancyMap drawn = empty;
    for (Eigen::Index k = 0; k < path.cols(); ++k) drawn.observe(scanner, path.col(k), walk.ranges.col(k));
    for (int y = 0; y < drawn.height(); ++y)
      for (int x = 0; x < drawn.width(); ++x) ASSERT_EQ(drawn.logOdds(x, y), slam.map(i).logOdds(x, y));
  }
}

TEST(GridSlam, GoesOnWithoutAnythingToMatch) {
  Rng rng(7);
  const RangeScanner scanner = scannerOf(4, 1);
  const Eigen::VectorXd nothing = Eigen::VectorXd::Ones(4);  // no ray hits anything
  GridSlam slam({0, 0, 0}, OccupancyMap(20, 20, .1, {-1, -1}), scanner, nothing, {.particles = 200});
  (void)slam.step(odometryTransition({.5, 0, 0}, {.1, .1, .1}), nothing, rng);
  const Eigen::Vector3d mean = slam.poses() * slam.weights();
  EXPECT_LT((mean - Eigen::Vector3d(.5, 0, 0)).norm(), .05);
  EXPECT_NEAR((slam.poses().row(0).array() - mean[0]).square().matrix().dot(slam.weights()), .01, .004)
      << "the motion's own noise";
}

TEST(GridSlam, SaysWhatIsWrong) {
  Rng rng(8);
  const RangeScanner scanner = scannerOf(4, 5);
  const OccupancyMap empty(20, 20, .1);
  const Eigen::VectorXd ranges = Eigen::VectorXd::Ones(4);
  const auto make = [&](GridSlamOptions options) {
    return GridSlam({1, 1, 0}, empty, scanner, ranges, options);
  };
  EXPECT_REX_ERROR(make({.particles = 0}), "particles: found 0, wanted at least 1");
  EXPECT_REX_ERROR(make({.threshold = 2}), "resampling threshold: found 2, wanted 0 to 1");
  EXPECT_REX_ERROR(make({.deviation = 0}), "deviation of the end points of rays: found 0 m");
  EXPECT_REX_ERROR(make({.temper = .5}), "temper of the rays: found 0.5, wanted 1 or more");
  EXPECT_REX_ERROR(make({.draws = 0}), "draws around a match: found 0, wanted at least 1");
  EXPECT_REX_ERROR(make({.evidence = {.hit = .2}}), "evidence of rays");
  EXPECT_REX_ERROR(GridSlam({1, 1, 0}, empty, scanner, Eigen::VectorXd::Ones(3)),
                   "ranges: found a vector of size 3");
  GridSlam slam = make({.particles = 2});
  const PoseTransition good = odometryTransition({0, 0, 0}, {.1, .1, .1});
  EXPECT_REX_ERROR(slam.step({}, ranges, rng), "transition: found no function for its mean");
  EXPECT_REX_ERROR(slam.step(odometryTransition({0, 0, 0}, {0, 0, 0}), ranges, rng),
                   "transition: covariance of the noise");
  EXPECT_REX_ERROR(slam.step(good, -ranges, rng), "ranges: number 0: found -1");
  EXPECT_REX_ERROR(
      slam.step({.mean = [](const Eigen::Vector3d& x) { return (x / 0.).eval(); }, .noise = good.noise},
                ranges, rng),
      "next pose: number 0: found inf");
  EXPECT_EQ(slam.path(0).cols(), 1) << "a throw changes nothing";
  EXPECT_REX_ERROR(slam.map(2), "particle: found 2, wanted 0 to 1");
  EXPECT_REX_ERROR(slam.path(-1), "particle: found -1, wanted 0 to 1");
}

}  // namespace rex::grid_slam_test
