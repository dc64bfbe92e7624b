// RRT-Connect: two trees of postures, from start and goal, find a way around a wall; shortcuts make it short.
#include <iostream>

#include "course/course.h"
#include "planning/robot_problem.h"
#include "planning/rrt.h"
#include "planning/smooth_path.h"

using namespace rex;

int main() {
  Simulator S("arm7dof");
  S.addObstacle({.type = ShapeType::kBox, .extent = {0.4, 0.04, 0.5}}, translation(0.6, 0, 0.25), "wall");
  S.setJointAngles(S.inverseKinematics("tool", Eigen::Vector3d(0.4, 0.35, 0.3)).q);
  const ReachedPosture goal = S.inverseKinematics("tool", Eigen::Vector3d(0.4, -0.35, 0.3));

  // A way is checked every 0.01 rad; at most 1e5 samples. The same seed finds the same way.
  const ContactModel contacts(S.model());
  const PathProblem problem = robotProblem(S.model(), contacts, S.getJointAngles(), goal.q);
  Rng rng(1);
  const PathResult found = connectRrts(problem, {}, rng);
  std::cout << found.message << "\n";
  if (found.status != PathStatus::kFound) return 1;
  const Eigen::MatrixXd path = shortcut(problem, found.path, 200, rng);
  print("length as found", found.length);
  print("length with shortcuts", pathLength(problem.space, path));

  Eigen::VectorXd q(S.getJointDimension());
  for (int i = 0; i + 1 < path.cols(); ++i)
    for (double t = 0; t < 1; t += 0.05 / problem.space.distance(path.col(i), path.col(i + 1))) {
      problem.space.interpolate(path.col(i), path.col(i + 1), t, q);
      S.setJointAngles(q);
    }
  S.setJointAngles(goal.q);
  writeReplay(S, "plan", {.traces = {"tool"}});
}
