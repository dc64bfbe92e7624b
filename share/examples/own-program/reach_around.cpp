// From a robot's file to a film: inverse kinematics, RRT-Connect around a wall, a spline, and times within
// the robot's limits. It is built with an installed rex, by CMakeLists.txt beside it or by pkg-config:
//   c++ -O2 reach_around.cpp $(pkg-config --cflags --libs rex-course_inverse_kinematics rex-planning)
#include <iostream>

#include "course/course.h"
#include "planning/path_spline.h"
#include "planning/robot_problem.h"
#include "planning/rrt.h"
#include "planning/smooth_path.h"
#include "planning/time_parametrization.h"

using namespace rex;

int main(int argc, char** argv) {
  Simulator S(argc > 1 ? argv[1] : "arm7dof.urdf");
  S.addObstacle({.type = ShapeType::kBox, .extent = {0.4, 0.04, 0.5}}, translation(0.6, 0, 0.25), "wall");
  S.setJointAngles(S.inverseKinematics("tool", Eigen::Vector3d(0.4, 0.35, 0.3)).q);
  const ReachedPosture goal = S.inverseKinematics("tool", Eigen::Vector3d(0.4, -0.35, 0.3));

  const PathProblem problem = robotProblem(S.model(), ContactModel(S.model()), S.getJointAngles(), goal.q);
  Rng rng(1);
  const PathResult found = connectRrts(problem, {}, rng);
  if (found.status != PathStatus::kFound) {
    std::cerr << found.message << "\n";
    return 1;
  }
  const SplineResult way = splineAlong(problem, shortcut(problem, found.path, 200, rng));
  const TimingResult timing = parametrizeTime(way.spline.curve(), jointLimits(S.model()).limits);
  if (timing.status != TimingStatus::kFound) {
    std::cerr << timing.message << "\n";
    return 1;
  }
  print("duration [s]", timing.motion.duration());
  for (double t = 0; t < timing.motion.duration(); t += 1. / 30)
    S.setJointAngles(timing.motion.at(t).q, 1. / 30);
  writeReplay(S, "reach_around", {.traces = {"tool"}});
}
