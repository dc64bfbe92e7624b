// Chapter 7: SLAM with a grid map. A robot goes through an office with wheels that slip. Each particle has a
// path and the map which that path draws; shown is the likeliest, beside the way by odometry alone (orange).
// Without matching scans to their maps, particles have to guess, and walls double. Each walk prints how true
// map and path became.
// Slides: 7:33, 7:39
// Formula: log-odds of a cell: l ← l + log (P(occupied|y) / P(free|y)), one map for each particle
// Try: Particles map an office; orange is the odometry. Keep 1 of the "particles" and press "match scans or
// not": the map is as wrong as the odometry.
#include <cstdio>
#include <numbers>

#include "course/car_pictures.h"
#include "course/course.h"
#include "course/live_view.h"
#include "estimation/building.h"
#include "estimation/grid_slam.h"
#include "estimation/occupancy_map.h"
#include "estimation/scan_matching.h"
#include "estimation/scan_walk.h"
#include "geometry/rotation.h"
#include "render/picture.h"

using namespace rex;

// In cells of 0.25 m, occupied where one of the finer ones is: a replay of finer maps would be large.
OccupancyMap coarse(const OccupancyMap& map) {
  OccupancyMap shown = emptyOffice(0.25);
  for (int y = 0; y < map.height(); ++y)
    for (int x = 0; x < map.width(); ++x) {
      const double value = map.logOdds(x, y);
      const Eigen::Vector2i at =
          shown.cellAt(map.origin() + map.cellSize() * Eigen::Vector2d(x + 0.5, y + 0.5));
      if (!shown.contains(at.x(), at.y()) || value == 0) continue;
      const double before = shown.logOdds(at.x(), at.y());
      shown.setLogOdds(at.x(), at.y(), before == 0 ? value : std::max(before, value));
    }
  return shown;
}

struct Robot {
  Rng rng;
  RangeScanner scanner{.maxRange = 8};
  ScanWalk walk{};
  Eigen::Matrix3Xd reckoned{};  // from odometry alone
  std::optional<GridSlam> slam{};
  int step = 0, resampled = 0;
  WalkNoise noise{};

  Robot(std::uint64_t seed, int particles, double slip, bool matches)
      : rng(seed), noise{.odometry = slip * Eigen::Vector3d(1, 1, 2. / 3)} {
    for (int i = 0; i < 120; ++i) scanner.angles.push_back(2 * std::numbers::pi * i / 120);
    walk = measured(officeBuilding(), posesAlong(officeWalk(), 0.5, 0.5), scanner, noise, rng);
    reckoned = walk.truth;
    for (Eigen::Index k = 1; k < reckoned.cols(); ++k)
      reckoned.col(k) = movedPose(reckoned.col(k - 1), walk.odometry.col(k));
    slam.emplace(walk.truth.col(0), emptyOffice(0.1), scanner, walk.ranges.col(0),
                 GridSlamOptions{.particles = particles, .matchScans = matches});
  }

  bool isDone() const { return step + 1 == walk.truth.cols(); }
  void move() {
    ++step;
    const PoseTransition motion = odometryTransition(walk.odometry.col(step), noise.odometry);
    resampled += slam->step(motion, walk.ranges.col(step), rng).resampled;
  }
  Eigen::Matrix3Xd path() const { return slam->path(slam->likeliest()); }
  // Root mean squares along the walk so far: metres and radians.
  Eigen::Vector2d error(const Eigen::Matrix3Xd& poses) const {
    Eigen::Matrix3Xd errors = poses.leftCols(step + 1) - walk.truth.leftCols(step + 1);
    for (double& heading : errors.row(2)) heading = wrapAngle(heading);
    return Eigen::Vector2d(errors.topRows<2>().norm(), errors.row(2).norm()) / std::sqrt(step + 1.);
  }
  void print(std::uint64_t seed, bool matches) const {
    OccupancyMap truth = emptyOffice(0.1);
    rasterize(officeBuilding(), truth);
    const MapAgreement map = compareMaps(slam->map(slam->likeliest()), truth);
    const Eigen::Vector2d own = error(path());
    std::printf("%4d  %-8s %7.3f %10.3f %7.3f %10.3f %9.4f %13.3f %10d\n", static_cast<int>(seed),
                matches ? "matched" : "ignored", map.overlap, map.precision, map.recall, own[0], own[1],
                error(reckoned)[0], resampled);
    std::fflush(stdout);
  }
  CarView view() const {
    const Eigen::Matrix3Xd mine = path();
    const Eigen::Vector3d now = mine.rightCols<1>();
    Eigen::Matrix2Xd hits = scanPoints(scanner, walk.ranges.col(step));
    for (auto p : hits.colwise()) p = movedPose(now, {p.x(), p.y(), 0}).head<2>().eval();
    return {.car = walk.truth.col(step),
            .estimate = now,
            .carScale = 0.25,
            .map = coarse(slam->map(slam->likeliest())),
            .particles = slam->poses(),
            .weights = slam->weights(),
            .paths = {{.name = "true way", .points = walk.truth.topLeftCorner(2, step + 1)},
                      {.name = "odometry",
                       .points = reckoned.topLeftCorner(2, step + 1),
                       .color = kDeadReckoningColor},
                      {.name = "estimate", .points = mine.topRows<2>(), .color = kEstimateColor}},
            .scan = hits};
  }
};

int main(int argc, char** argv) {
  std::uint64_t seed = argc > 1 ? std::stoull(argv[1]) : 0;
  const int runs = argc > 2 ? std::stoi(argv[2]) : 1;
  LiveView view("map");
  view.lookFrom({0, -0.4, 1});
  std::printf("seed  scans    overlap  precision  recall  error [m]     [rad]  odometry [m]  resampled\n");
  std::optional<Robot> robot;
  bool matches = true;
  // Each seed with and without matching.
  for (int run = 0, t = 0; run < 2 * runs || view.isWatched(); ++t) {
    const int particles = static_cast<int>(view.slider("particles", 1, 40, 15));
    const double slip = view.slider("noise of the odometry [m]", 0.005, 0.06, 0.03);
    if (view.button("match scans or not")) matches = !matches, robot.reset();
    if (view.button("from the start")) robot.reset();
    if (!robot) robot.emplace(seed, particles, slip, matches);
    if (t % 2 == 0 || !view.isWatched()) robot->move();
    if ((run < 2 && robot->step % 2 == 0) || view.isWatched()) {
      CarView seen = robot->view();
      seen.caption = matches ? "scans are matched" : "motion alone";
      view.plot(matches ? "error [m]" : "error by motion alone [m]", robot->step,
                robot->error(robot->path())[0], "step");
      view.plot("error of the odometry [m]", robot->step, robot->error(robot->reckoned)[0], "step");
      view.show(carPicture(seen));
    }
    if (!robot->isDone()) continue;
    robot->print(seed, matches);
    robot.reset(), ++run;
    if (!matches) ++seed;
    matches = !matches;
  }
}
