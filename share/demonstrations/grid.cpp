// Chapter 7: SLAM with a grid map. A robot goes through an office with wheels that slip. Each particle has a
// path and the map which that path draws; shown is the likeliest. Orange is the way by odometry alone: one
// particle that matches no scans believes it.
#include <memory>
#include <numbers>

#include "course/car_pictures.h"
#include "course/course.h"
#include "course/live_view.h"
#include "estimation/building.h"
#include "estimation/grid_slam.h"
#include "estimation/scan_walk.h"
#include "render/picture.h"

using namespace rex;

int main() {
  constexpr int kRays = 40;
  const Building office = officeBuilding();
  const Eigen::Matrix3Xd poses = posesAlong(officeWalk(), 0.15, 0.15);
  RangeScanner scanner{.maxRange = 8};
  for (int i = 0; i < kRays; ++i) scanner.angles.push_back(2 * std::numbers::pi * i / kRays);
  const OccupancyMap empty(101, 69, 0.25, {-0.625, -0.625});
  LiveView view("grid");
  view.lookFrom({0, -0.4, 1});
  Rng rng(1);
  ScanWalk walk;
  std::unique_ptr<GridSlam> slam;
  Eigen::Matrix3Xd reckoned;
  bool matching = true;
  Eigen::Index at = 0;
  for (int t = 0; t < 300 || view.isWatched(); ++t) {
    const int particles = static_cast<int>(view.slider("particles", 1, 40, 12));
    const double slip = view.slider("noise of the odometry", 0.005, 0.06, 0.025);
    const Eigen::Vector3d deviations(slip, slip, slip / 2);
    if (view.button("match scans or not")) matching = !matching, slam.reset();
    if (view.button("from the start") || at + 1 == poses.cols()) slam.reset();
    if (slam) {
      ++at;
      slam->step(odometryTransition(walk.odometry.col(at), deviations), walk.ranges.col(at), rng);
      reckoned.col(at) = movedPose(reckoned.col(at - 1), walk.odometry.col(at));
    } else {
      walk = measured(office, poses, scanner, {.odometry = deviations}, rng);
      reckoned = poses;
      at = 0;
      slam = std::make_unique<GridSlam>(poses.col(0), empty, scanner, walk.ranges.col(0),
                                        GridSlamOptions{.particles = particles, .matchScans = matching});
    }
    const int best = slam->likeliest();
    const Eigen::Matrix3Xd path = slam->path(best);
    const Eigen::Vector3d now = path.rightCols<1>(), truth = poses.col(at);
    CarView seen{.car = truth,
                 .estimate = now,
                 .carScale = 0.3,
                 .map = slam->map(best),
                 .particles = slam->poses(),
                 .weights = slam->weights(),
                 .ways = {{.name = "true way", .points = poses.topLeftCorner(2, at + 1)},
                          {.name = "odometry",
                           .points = reckoned.topLeftCorner(2, at + 1),
                           .color = kDeadReckoningColor},
                          {.name = "estimate", .points = path.topRows<2>(), .color = kEstimateColor}},
                 .caption = matching ? "scans are matched" : "motion alone"};
    if (at == 0) seen.ways.clear();
    view.plot("error of the pose [m]", t / 30., (now - truth).head<2>().norm());
    view.plot("error of the odometry [m]", t / 30., (reckoned.col(at) - truth).head<2>().norm());
    view.show(pictureOf(seen));
  }
}
