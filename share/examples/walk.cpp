// A humanoid walks: footsteps, preview control of the zero moment point, inverse kinematics for each posture.
#include <iostream>

#include "course/course.h"
#include "course/walk_pictures.h"
#include "locomotion/walking_pattern.h"

using namespace rex;

int main() {
  Simulator S("humanoid", {.freeBase = true});
  Eigen::VectorXd q = S.getJointAngles();
  const std::vector<std::string> joints = S.getJointNames();
  q[2] = 0.84;  // the height of the pelvis
  for (int i = 0; i < q.size(); ++i) {
    if (joints[i].ends_with("_hip_pitch") || joints[i].ends_with("_ankle_pitch")) q[i] = -0.35;
    if (joints[i].ends_with("_knee")) q[i] = 0.7;
  }

  const Model& robot = S.model();
  const Legs legs{.leftFoot = robot.body("left_foot"),
                  .rightFoot = robot.body("right_foot"),
                  .trunk = robot.body("pelvis"),
                  .p_FS = {0.03, 0, -0.075}};
  const WalkPlan plan{.footsteps =
                          straightFootsteps(4, 0.2, 0.19)};  // steps, their length, the feet's distance
  const WalkOptions options;
  const WalkingPattern walk = walkingPattern(robot, legs, plan, q, options);
  if (walk.status != WalkingPattern::Status::kWalks) {
    std::cerr << walk.message << "\n";
    return 1;
  }
  print("seconds", duration(plan));
  for (int t = 0; t < walk.Q.cols(); t += 4) S.setJointAngles(walk.Q.col(t), 4 * options.preview.step);
  print("pelvis [m]", S.kinematicsPos("pelvis"));
  writeReplay(S, "walk", {.traces = {"left_foot", "right_foot"}}, {footprintFigure(plan)});
}
