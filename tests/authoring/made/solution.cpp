// <solution introduction>
// Reference solution of 97-made.
// <todo>
//| // Your solution of 97-made. The task is in README.md, the contract in exercise.h.
// </solution>
#include "exercise.h"
#include "show.h"

// Part 1: turning.

Eigen::Vector2d turned(const Eigen::Vector2d& p, double angle) {
  // <solution turned>
  Eigen::Vector2d missing = Eigen::Vector2d::Zero();  // instead of this, the solution
  return missing;
  // <todo>
  //| // TODO: The point p [m] turned about the origin by `angle` [rad], counter-clockwise: the x
  //| // axis turned by a quarter is the y axis.
  //| return Eigen::Vector2d::Zero();
  // </solution>
}

Eigen::VectorXd angles(const std::vector<Eigen::Vector2d>& points, int count) {
  // <solution angles>
  Eigen::VectorXd missing = {};  // instead of this, the solution
  return missing;
  // <todo>
  //| // TODO: The point p [m] turned about the origin by `angle` [rad], counter-clockwise: the x
  //| // axis turned by a quarter is the y axis.
  //| return {};
  // </solution>
}

bool isStill(const Body& body, int k, double wanted) {
  // <solution isStill>
  bool missing = false;  // instead of this, the solution
  return missing;
  // <todo>
  //| // TODO: Whether the body stays where it is for so many steps.
  //| return false;
  // </solution>
}

// Part 2: poses.

rex::Pose posed(const rex::Pose& start, rex::Rng& rng) {
  // <solution posed>
  rex::Pose missing = {};  // instead of this, the solution
  return missing;
  // <todo>
  //| // TODO: The pose after a random step.
  //| return {};
  // </solution>
}

std::vector<Eigen::VectorXd> longest(rex::Simulator& S, const Eigen::MatrixXd& A) {
  // <solution longest>
  std::vector<Eigen::VectorXd> missing = {};  // instead of this, the solution
  return missing;
  // <todo>
  //| // TODO: The longest motions of the hand of S.
  //| return {};
  // </solution>
}

int main() {
  // Part 1: call turned, angles, isStill, and print the values.
  // Part 2: call posed, longest, and print the values.
  showResult({0, 1, 4, 9}, {{0, 0, 0}, {0.2, 0, 0.3}, {0.4, 0, 0.4}, {0.6, 0, 0.3}});
}
