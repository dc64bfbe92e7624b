#include "estimation/building.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "base/rng.h"
#include "estimation/occupancy_map.h"
#include "estimation/scan_walk.h"
#include "geometry/rotation.h"
#include "support/expect_error.h"

namespace rex::building_test {

// Rays cast in the raster meet walls where the walls are, up to a cell.
TEST(Building, RasterAgreesWithItsWalls) {
  const Building office = officeBuilding();
  OccupancyMap map(501, 341, .05, {-.525, -.525});
  rasterize(office, map);
  Rng rng(31);
  for (int i = 0; i < 300; ++i) {
    const Eigen::Vector2d p(rng.uniform(.2, 23.8), rng.uniform(.2, 15.8));
    if (map.isOccupied(map.cellAt(p)[0], map.cellAt(p)[1])) continue;
    const double angle = rng.uniform(-3, 3), exact = distanceToWall(office, p, angle, 30);
    EXPECT_LT(exact, 24) << "the office is closed";
    const double cells = map.distanceToOccupied(p, angle, 30);
    EXPECT_LE(cells, exact + 1e-9) << "a wall lies in a cell";
    // The first cell that a ray meets contains a wall, which a ray along the wall may miss.
    const Eigen::Vector2d met = p + (cells + 1e-6) * Eigen::Vector2d(std::cos(angle), std::sin(angle));
    double nearest = 1e9;
    for (const Eigen::Vector4d& wall : office.walls) {
      const Eigen::Vector2d a = wall.head<2>(), d = wall.tail<2>() - a;
      const double t = std::clamp((met - a).dot(d) / d.squaredNorm(), 0., 1.);
      nearest = std::min(nearest, (a + t * d - met).norm());
    }
    EXPECT_LT(nearest, .05 * std::sqrt(2.));
  }
}

// The middle of the outer walls is the middle of cells, for cells that divide half a metre.
TEST(Building, EmptyMapsHoldTheOffice) {
  for (const double size : {.05, .1, .25, .5}) {
    const OccupancyMap map = emptyOffice(size);
    for (const Eigen::Vector2d& corner : {Eigen::Vector2d(0, 0), {24, 0}, {0, 16}, {24, 16}}) {
      const Eigen::Vector2i cell = map.cellAt(corner);
      EXPECT_TRUE(map.contains(cell.x(), cell.y())) << size;
      EXPECT_EQ(map.logOdds(cell.x(), cell.y()), 0);
      EXPECT_EQ(map.cellAt(corner + Eigen::Vector2d(.49, .49) * size), cell) << size;
      EXPECT_EQ(map.cellAt(corner - Eigen::Vector2d(.49, .49) * size), cell) << size;
    }
  }
}

TEST(Building, WalksAreMeasured) {
  const Building office = officeBuilding();
  const Eigen::Matrix3Xd poses = posesAlong(officeWalk(), .5, .5);
  for (Eigen::Index k = 1; k < poses.cols(); ++k) {
    EXPECT_LE((poses.col(k) - poses.col(k - 1)).head<2>().norm(), .5 + 1e-9);
    EXPECT_LE(std::abs(wrapAngle(poses(2, k) - poses(2, k - 1))), .5 + 1e-9);
    EXPECT_GT(distanceToWall(office, poses.col(k).head<2>(), poses(2, k), 1), .15);
  }
  const RangeScanner scanner{.angles = {-1, 0, 2}, .maxRange = 6};
  Rng rng(32);
  const ScanWalk exact =
      measured(office, poses, scanner, {.odometry = Eigen::Vector3d::Zero(), .range = 0}, rng);
  Eigen::Vector3d pose = poses.col(0);
  for (Eigen::Index k = 0; k < poses.cols(); ++k) {
    pose = movedPose(pose, exact.odometry.col(k));
    EXPECT_LT((pose - poses.col(k)).head<2>().norm() + std::abs(wrapAngle(pose[2] - poses(2, k))), 1e-9);
    EXPECT_EQ(exact.ranges(1, k), distanceToWall(office, poses.col(k).head<2>(), poses(2, k), 6));
  }
  const ScanWalk noisy = measured(office, poses, scanner, {}, rng);
  EXPECT_NEAR((noisy.ranges - exact.ranges).norm() / std::sqrt(exact.ranges.size()), .02, .004);
  const Eigen::Matrix3Xd errors = noisy.odometry - exact.odometry;
  const double count = static_cast<double>(poses.cols() - 1);
  EXPECT_NEAR(errors.topRows<2>().norm() / std::sqrt(2 * count), .03, .004);
  EXPECT_NEAR(errors.row(2).norm() / std::sqrt(count), .02, .004);
}

TEST(ScanWalk, OdometryHasItsJacobian) {
  const PoseTransition motion = odometryTransition({.5, -.2, .3}, {.1, .1, .2});
  const Eigen::Vector3d x(1, 2, .7);
  Eigen::Matrix3d numeric;
  for (int k = 0; k < 3; ++k) {
    const Eigen::Vector3d h = 1e-6 * Eigen::Vector3d::Unit(k);
    numeric.col(k) = (motion.mean(x + h) - motion.mean(x - h)) / 2e-6;
  }
  EXPECT_LT((motion.jacobian(x) - numeric).norm(), 1e-8);
  EXPECT_EQ(motion.noise.diagonal(), Eigen::Vector3d(.1 * .1, .1 * .1, .2 * .2));
}

TEST(MapAgreement, CountsCells) {
  OccupancyMap truth(7, 5, 1), map(7, 5, 1);
  for (int x = 0; x < 7; ++x) truth.setLogOdds(x, 2, 5);
  EXPECT_EQ(compareMaps(map, truth).overlap, 0);
  for (int x = 0; x < 5; ++x) {
    map.setLogOdds(x, 2, -1);
    map.setLogOdds(x, 3, x < 4 ? 1 : -1);
  }
  map.setLogOdds(6, 0, 1);
  const MapAgreement near = compareMaps(map, truth), exact = compareMaps(map, truth, 0);
  EXPECT_NEAR(near.precision, 4. / 5, 1e-12);
  EXPECT_NEAR(near.recall, 5. / 5, 1e-12) << "two cells of the wall were not observed";
  EXPECT_NEAR(near.overlap, 2 * .8 / 1.8, 1e-12);
  EXPECT_EQ(exact.precision, 0);
  EXPECT_EQ(compareMaps(truth, truth, 0).overlap, 1);
}

TEST(Building, SaysWhatIsWrong) {
  Rng rng(33);
  const Building office = officeBuilding();
  const RangeScanner scanner{.angles = {0}, .maxRange = 5};
  const Eigen::Vector3d pose(1, 1, 0);
  EXPECT_REX_ERROR(noisyRanges(office, {.angles = {0}, .maxRange = 0}, pose, .1, rng),
                   "scanner: largest range");
  EXPECT_REX_ERROR(noisyRanges(office, scanner, {0, 0, INFINITY}, .1, rng), "pose of the scanner: number 2");
  EXPECT_REX_ERROR(noisyRanges(office, scanner, pose, -1, rng), "deviation of ranges: found -1 m");
  EXPECT_REX_ERROR(measured(office, pose, scanner, {.odometry = {-1, 0, 0}}, rng),
                   "deviations of the odometry");
  EXPECT_REX_ERROR(posesAlong({{0, 0}}, 1, 1), "points of the walk: found 1, wanted at least 2");
  EXPECT_REX_ERROR(posesAlong({{0, 0}, {0, 0}}, 1, 1),
                   "points 0 and 1 of the walk: found the same position, wanted different ones");
  EXPECT_REX_ERROR(posesAlong({{0, 0}, {0, INFINITY}}, 1, 1), "length of the walk: found inf m");
  EXPECT_REX_ERROR(posesAlong({{0, 0}, {0, 1}}, 0, 1), "step of the walk: found 0 m");
  EXPECT_REX_ERROR(posesAlong({{0, 0}, {0, 1}}, 1, 0), "turn of the walk: found 0 rad");
  EXPECT_REX_ERROR(odometryTransition({0, 0, NAN}, {1, 1, 1}), "measured motion: number 2: found nan");
  EXPECT_REX_ERROR(odometryTransition({0, 0, 0}, {1, 1, -1}),
                   "deviations of the odometry: number 2: found -1");
  EXPECT_REX_ERROR(odometryTransition({0, 0, 0}, {1, 2, 1}),
                   "deviations of the odometry: found 1 m in x, 2 m in y, wanted the same in both");
  EXPECT_REX_ERROR(compareMaps({2, 3, 1}, {3, 2, 1}),
                   "maps to compare: found 2 x 3 and 3 x 2 cells, wanted the same size");
  EXPECT_REX_ERROR(compareMaps({2, 3, 1}, {2, 3, 1}, -1), "reach of the comparison: found -1");
}

}  // namespace rex::building_test
