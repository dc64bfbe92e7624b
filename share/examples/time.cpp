// How fast can a cart follow its way through a maze? A spline rounds the corners; TOPP-RA gives it times
// within the limits of velocity and acceleration.
#include <iostream>

#include "course/course.h"
#include "planning/path_spline.h"
#include "planning/robot_problem.h"
#include "planning/rrt.h"
#include "planning/smooth_path.h"
#include "planning/time_parametrization.h"

using namespace rex;

int main() {
  Simulator S("maze");
  const Eigen::Vector3d goal(3, 0, 0);  // x, y and heading, from where the cart stands
  const PathProblem problem = robotProblem(S.model(), ContactModel(S.model()), S.getJointAngles(), goal);
  Rng rng(1);
  const PathResult found = connectRrts(problem, {}, rng);
  const SplineResult way = splineAlong(problem, shortcut(problem, found.path, 200, rng));
  const TimingResult timing = parametrizeTime(way.spline.curve(), jointLimits(S.model()).limits);
  if (timing.status != TimingStatus::kFound) {
    std::cerr << timing.message << "\n";
    return 1;
  }
  print("duration [s]", timing.motion.duration());

  Series x{.label = "x"}, y{.label = "y"};
  for (double t = 0; t < timing.motion.duration(); t += 1. / 30) {
    const MotionPoint now = timing.motion.at(t);
    S.setJointAngles(now.q, 1. / 30);
    x.x.push_back(t), x.y.push_back(now.v[0]);
    y.x.push_back(t), y.y.push_back(now.v[1]);
  }
  const Figure speeds{
      .title = "As fast as it may", .xLabel = "time [s]", .yLabel = "velocity [m/s]", .series = {x, y}};
  writeReplay(S, "time", {.traces = {"cart"}}, {speeds});
}
