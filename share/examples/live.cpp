// A program that is watched while it runs: the hand of an arm follows a slider by inverse kinematics, slide
// 2:29. In a terminal, the address of the page is the first line; elsewhere the program writes the replay
// live.html.
#include <iostream>

#include "course/course.h"
#include "course/live_view.h"

using namespace rex;

int main() {
  Simulator S("arm3");
  LiveView view("live");
  const Eigen::VectorXd rest = S.getJointAngles();
  double distance = 0;
  for (int t = 0; t < 150 || view.isWatched(); ++t) {
    const double height = view.slider("height of the hand [m]", 0.6, 1.8, 1.2);
    const double damping = view.slider("damping", 0.01, 1, 0.1);
    Eigen::VectorXd q = S.getJointAngles();
    if (view.button("home")) q = rest;
    const Eigen::Vector3d missing = Eigen::Vector3d(0, -0.5, height) - S.kinematicsPos("eff");
    const Eigen::MatrixXd J = S.jacobianPos("eff");
    const Eigen::Matrix3d A = J * J.transpose() + damping * Eigen::Matrix3d::Identity();
    const Eigen::Vector3d push = inverse(A) * missing;
    q += J.transpose() * push;
    S.setJointAngles(q);
    distance = missing.norm();
    view.plot("distance [m]", t / 30., distance);
    view.show(S);
  }
  std::cout << "distance at the end [m] " << distance << "\n";
}
