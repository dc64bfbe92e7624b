// Loads a robot, says what can move and how far, and draws it.
#include <iostream>

#include "course/course.h"

using namespace rex;

int main() {
  Simulator S("arm7dof");  // or the path of your own .urdf or .ors file

  const std::vector<std::string> joints = S.getJointNames();
  const Eigen::VectorXd lower = S.getLowerLimits(), upper = S.getUpperLimits();
  for (int i = 0; i < S.getJointDimension(); ++i)
    std::cout << joints[i] << ": " << lower[i] << " to " << upper[i] << " rad\n";

  S.setJointAngles(Eigen::VectorXd::Constant(S.getJointDimension(), 0.5));
  for (const std::string& body : S.getBodyNames()) print(body + " [m]", S.kinematicsPos(body));
  print("Jacobian of the tool", S.jacobianPos("tool"));
  writePicture(S, "arm.png", {.caption = "half a radian in each joint"});
}
