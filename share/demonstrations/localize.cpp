// Chapter 7: Localisation in a known map. A robot knows the map of an office, but not where it is in it.
// Particles that its scans weigh find it; half way somebody carries it elsewhere. Drawing a tenth of the
// particles from the scan alone finds it again, without them it stays lost for long. Each run prints when the
// mean was within half a metre for good.
// Slides: 7:22, 7:25
// Formula: w_i ~ P(y|x_i) P(x_i|u) / q(x_i) with a proposal q that knows the scan
// Try: Particles find the robot in an office, also after a kidnapping. Press "draw from scans or not": it
// stays lost, or is found late.
#include <cstdio>
#include <numbers>

#include "course/car_pictures.h"
#include "course/course.h"
#include "course/live_view.h"
#include "estimation/building.h"
#include "estimation/scan_matching.h"
#include "estimation/scan_walk.h"
#include "estimation/scan_weights.h"
#include "geometry/rotation.h"
#include "render/picture.h"

using namespace rex;

// Where the robot can get from a pose. What is outside, and inside of furniture, stays unknown.
OccupancyMap reachableMap(const Eigen::Vector3d& pose) {
  OccupancyMap map = emptyOffice(0.1), truth = map;
  rasterize(officeBuilding(), truth);
  std::vector<Eigen::Vector2i> open{truth.cellAt(pose.head<2>())};
  while (!open.empty()) {
    const Eigen::Vector2i at = open.back();
    open.pop_back();
    if (!map.contains(at.x(), at.y()) || map.logOdds(at.x(), at.y()) != 0) continue;
    map.setLogOdds(at.x(), at.y(), truth.logOdds(at.x(), at.y()));
    if (truth.isOccupied(at.x(), at.y())) continue;
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx) {
        const Eigen::Vector2i next = at + Eigen::Vector2i(dx, dy);
        // Not past the corners of cells, which oblique walls consist of.
        if (dx == 0 || dy == 0 || truth.isOccupied(next.x(), next.y())) open.push_back(next);
      }
  }
  return map;
}

struct Robot {
  Rng rng;
  RangeScanner scanner{.maxRange = 5};  // with 12 rays it sees so little that rooms look alike
  WalkNoise noise{};
  ScanWalk before{}, after{};  // the kidnapping
  std::optional<OccupancyMap> map{};
  std::optional<ScanLookup> lookup{};
  std::optional<ParticleFilter> filter{};
  double share = 0;  // of the particles, drawn from the scan
  Eigen::Vector3d truth{}, mean{};
  std::vector<Eigen::Vector2d> errors{};  // metres, radians

  Robot(std::uint64_t seed, int particles, double drawn) : rng(seed), share(drawn) {
    for (int i = 0; i < 12; ++i) scanner.angles.push_back(2 * std::numbers::pi * i / 12);
    // The second half of the walk comes first. Nobody measures the motion between both.
    const Eigen::Matrix3Xd poses = posesAlong(officeWalk(), 0.5, 0.5);
    const Eigen::Index half = poses.cols() / 2;
    before = measured(officeBuilding(), poses.rightCols(poses.cols() - half), scanner, noise, rng);
    after = measured(officeBuilding(), poses.leftCols(half), scanner, noise, rng);
    map = reachableMap(before.truth.col(0));
    lookup.emplace(*map, scanner);
    Particles all{Eigen::Matrix3Xd(3, particles), Eigen::VectorXd::Constant(particles, 1. / particles)};
    for (auto pose : all.states.colwise()) pose = lookup->anywhere().draw(rng);
    filter.emplace(all, ParticleFilterOptions{.resampling = Resampling::kSystematic});
  }

  int step() const { return static_cast<int>(errors.size()); }
  int kidnapped() const { return static_cast<int>(before.truth.cols()); }
  bool isDone() const { return step() == kidnapped() + after.truth.cols(); }
  const ScanWalk& walk(int k) const { return k < kidnapped() ? before : after; }
  Eigen::VectorXd ranges(int k) const { return walk(k).ranges.col(k < kidnapped() ? k : k - kidnapped()); }

  void move() {
    const int k = step(), i = k < kidnapped() ? k : k - kidnapped();
    const Eigen::Vector3d motion = walk(k).odometry.col(i);
    // Wider than the noises: particles are few for so large a building.
    const Eigen::Vector3d deviations = noise.odometry.array() + 0.02;
    const BeamModel beams{.deviation = std::hypot(0.15, noise.range), .temper = 3};
    const NonlinearModel moved{
        .g = [&](const Eigen::VectorXd& x) { return Eigen::VectorXd(movedPose(x, motion)); },
        .W = deviations.cwiseAbs2().asDiagonal()};
    (void)filter->step(
        mixtureProposal(moved, filter->particles(), lookup->given(ranges(k)),
                        {.share = share, .kidnapping = 0.01, .anywhere = lookup->anywhere(), .angles = {2}}),
        scanWeights(*map, scanner, ranges(k), beams), rng);
    const auto& [states, weights] = filter->particles();
    mean = states * weights;
    mean[2] = std::atan2(states.row(2).array().sin().matrix().dot(weights),
                         states.row(2).array().cos().matrix().dot(weights));
    truth = walk(k).truth.col(i);
    errors.emplace_back((mean - truth).head<2>().norm(), std::abs(wrapAngle(mean[2] - truth[2])));
  }

  // The first of these steps from which on the robot knows where it is; `end` if there is none.
  int found(int begin, int end) const {
    while (end > begin && errors[end - 1][0] < 0.5) --end;
    return end;
  }
  void print(std::uint64_t seed) const {
    const int first = found(0, kidnapped()), again = found(kidnapped(), step());
    std::printf("%4d %6g %6s %10d %12s", static_cast<int>(seed), share,
                first < kidnapped() ? std::to_string(first).c_str() : "never", kidnapped(),
                again < step() ? std::to_string(again).c_str() : "never");
    Eigen::Array2d squares(0, 0);
    for (int k = again; k < step(); ++k) squares += errors[k].array().square();
    const Eigen::Array2d error = (squares / std::max(1, step() - again)).sqrt();
    if (again < step()) std::printf(" %10.3f %10.4f", error[0], error[1]);
    std::printf("\n");
    std::fflush(stdout);
  }
  CarView view() const {
    Eigen::Matrix2Xd hits = scanPoints(scanner, ranges(step() - 1));
    for (auto p : hits.colwise()) p = movedPose(truth, {p.x(), p.y(), 0}).head<2>().eval();
    return {.car = truth,
            .carScale = 0.25,
            .map = map,
            .particles = filter->particles().states,
            .weights = filter->particles().weights,
            .scan = hits,
            .caption = step() > kidnapped() ? "kidnapped" : "where am I?"};
  }
};

int main(int argc, char** argv) {
  std::uint64_t seed = argc > 1 ? std::stoull(argv[1]) : 0;
  const int runs = argc > 2 ? std::stoi(argv[2]) : 1;
  LiveView view("localize");
  view.lookFrom({0, -0.25, 1});
  std::printf("seed  share  found  kidnapped  found again  error [m]      [rad]\n");
  std::optional<Robot> robot;
  bool draws = true;
  // Each seed with and without particles from the scan.
  for (int run = 0, t = 0; run < 2 * runs || view.isWatched(); ++t) {
    const int particles = static_cast<int>(view.slider("particles", 10, 2000, 500));
    const double share = view.slider("share from the scan", 0, 0.9, 0.1);
    if (view.button("draw from scans or not")) draws = !draws, robot.reset();
    if (view.button("from the start")) robot.reset();
    if (!robot) robot.emplace(seed, particles, draws ? share : 0);
    if (robot->errors.empty() || t % 2 == 0 || !view.isWatched()) robot->move();
    if (run < 2 || view.isWatched()) {
      view.plot(draws ? "error [m]" : "error, none from scans [m]", robot->step(), robot->errors.back()[0],
                "step");
      view.show(carPicture(robot->view()));
    }
    if (!robot->isDone()) continue;
    robot->print(seed);
    robot.reset(), ++run;
    if (!draws) ++seed;
    draws = !draws;
  }
}
