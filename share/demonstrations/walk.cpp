// Chapter 11: Walking in the simulated world. The humanoid walks on tiles of different heights; a controller
// of the capture point and of the whole body keeps it on its feet. The zero moment point measured from the
// contacts (orange) follows its plan. A push to the side at 4 s makes it step aside. Sliders change push and
// floor.
// Slides: 11:11
// Formula: ξ = x + x' / ω, ω = sqrt(g / z): the capture point ξ' = ω (ξ - zmp)
// Try: The humanoid walks in Bullet and is pushed at 4 s. Raise "push to the left" until it falls.
#include <cstdio>

#include "course/car_view.h"
#include "course/course.h"
#include "course/live_view.h"
#include "course/walk_pictures.h"
#include "kinematics/center_of_mass.h"
#include "locomotion/simulated_walk.h"
#include "render/picture.h"
#include "scene/scene_spec.h"

using namespace rex;

CourseHumanoid onTiles(const WalkPlan& plan, double unevenness, std::uint64_t seed) {
  SceneSpec floor;
  Rng rng(seed);
  addUnevenFloor(floor, plan, unevenness, 0.1, rng);
  return courseHumanoid(floor.worldShapes);
}

struct Walk {
  WalkPlan plan;
  CourseHumanoid humanoid;
  SimulatedWalk done;

  Walk(std::uint64_t seed, int steps, double length, double unevenness, const Eigen::Vector3d& push)
      : plan{.footsteps = straightFootsteps(steps, length, 0.19)},  // feet as wide apart as the hips
        humanoid(onTiles(plan, unevenness, seed)) {
    WalkPlan start = plan;
    start.footsteps.resize(2);
    const Eigen::VectorXd home =
        walkingPattern(humanoid.model, humanoid.legs, start, humanoid.start).Q.col(0);
    SimulatedWalkOptions options{.startAbove = unevenness};
    if (!push.isZero()) options.pushes = {{.time = 4, .impulse_W = push}};
    done = simulateWalk(humanoid.model, humanoid.legs, plan, home, options);
    std::printf("%4d %4g,%-4g %6.2f m %11.4f m %11.4f m %6.0f %% %s\n", static_cast<int>(seed), push[0],
                push[1], done.state.q[0] - home[0], done.largestCaptureError, done.rmsZmpError,
                100 * done.largestEffort, done.message.c_str());
    std::fflush(stdout);
  }

  // At a time; the last seconds of the zero moment point and of the centre of mass as lines on the ground.
  Picture at(std::size_t i, Polyline& zmp, Polyline& center) const {
    const WalkMeasurement& now = done.samples[i];
    const BodyPoses X = forwardKinematics(humanoid.model, now.q);
    Picture picture = scenePicture(humanoid.model, X);
    for (const Footstep& one : plan.footsteps)
      picture.solids.push_back(
          {{.type = ShapeType::kBox, .extent = {plan.sole.length, plan.sole.width, 0.004}},
           translation(one.p.x(), one.p.y(), 0.002),
           {0.7f, 0.72f, 0.76f},
           "footprint"});
    const Eigen::Vector3d c = centerOfMass(humanoid.model, X);
    center.points.emplace_back(c.x(), c.y(), 0.01);
    if (now.measured.exists) zmp.points.emplace_back(now.measured.p_W.x(), now.measured.p_W.y(), 0.01);
    for (Polyline* line : {&zmp, &center}) {
      if (line->points.size() > 90) line->points.erase(line->points.begin());
      if (line->points.size() > 1) picture.polylines.push_back(*line);
    }
    return picture;
  }
};

int main(int argc, char** argv) {
  std::uint64_t seed = argc > 1 ? std::stoull(argv[1]) : 0;
  const int runs = argc > 2 ? std::stoi(argv[2]) : 1;
  LiveView view("walk");
  view.lookFrom({0.35, -1, 0.5});
  std::printf("seed push [Ns]  walked  capture point  ZMP (rms)    effort\n");
  std::optional<Walk> walk;
  Eigen::Vector4d last = Eigen::Vector4d::Zero();
  Polyline zmp, center;
  double time = 0;
  bool pushed = false;
  // Without a push, then with one.
  for (int shown = 0; shown < 2 || view.isWatched();) {
    const Eigen::Vector4d now(
        view.slider("push to the left [N s]", -60, 60, 25), view.slider("push forward [N s]", -60, 60, 0),
        view.slider("tiles up to [m]", 0, 0.03, 0.005), view.slider("length of steps [m]", -0.2, 0.4, 0.2));
    if (view.button("push or not")) pushed = !pushed, walk.reset();
    if (view.button("another floor")) ++seed, walk.reset();
    if (!walk || now != last) {
      last = now, time = 0;
      zmp = {.color = kDeadReckoningColor, .width = 3}, center = {.color = kEstimateColor, .width = 3};
      const Eigen::Vector3d push(now[1], now[0], 0);
      walk.emplace(seed, 20, now[3], now[2], pushed ? push : Eigen::Vector3d(0, 0, 0));
    }
    const auto i = static_cast<std::size_t>(time / 0.002);
    if (i >= walk->done.samples.size()) {
      ++shown, pushed = !pushed, walk.reset();
      continue;
    }
    const WalkMeasurement& sample = walk->done.samples[i];
    Picture picture = walk->at(i, zmp, center);
    picture.captions = {{.text = pushed ? "pushed at 4 s" : "not pushed", .scale = 1.5}};
    const char* const names[] = {"planned y [m]", "measured y [m]", "planned, pushed [m]",
                                 "measured, pushed [m]"};
    view.plot(names[pushed ? 2 : 0], time, sample.control.plannedZmp.y());
    if (sample.measured.exists) view.plot(names[pushed ? 3 : 1], time, sample.measured.p_W.y());
    view.show(picture);
    time += 1. / 30;
  }
  for (int i = 1; i < runs; ++i) {
    (void)Walk(seed + static_cast<std::uint64_t>(i), 20, 0.2, 0.005, {0, 0, 0});
    (void)Walk(seed + static_cast<std::uint64_t>(i), 20, 0.2, 0.005, {0, 25, 0});
  }
}
