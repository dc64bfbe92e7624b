// Inverse kinematics: which posture brings the tool of an arm to a place, pointing downwards? The arm goes
// there.
#include <iostream>
#include <numbers>

#include "course/course.h"

using namespace rex;

int main() {
  Simulator S("arm7dof");
  const Eigen::VectorXd q0 = S.getJointAngles();

  // X_WB, the pose of the body B in the world W: 40 cm ahead, 30 cm to the right, 20 cm high, upside down.
  const Pose X_WB = translation(0.4, -0.3, 0.2) * rotation(std::numbers::pi, {1, 0, 0});
  const ReachedPosture goal = S.inverseKinematics("tool", X_WB);
  if (!goal.isReached) {
    std::cerr << goal.message << "\n";
    return 1;
  }
  print("posture [rad]", goal.q);

  for (int t = 0; t <= 60; ++t) S.setJointAngles(q0 + (goal.q - q0) * t / 60);
  print("tool [m]", S.kinematicsPos("tool"));
  writeReplay(S, "reach", {.traces = {"tool"}, .points = {X_WB.p}});
}
