// <solution introduction>
// Reference solution of @EXERCISE@.
// <todo>
//| // Your solution of @EXERCISE@. The task is in README.md, the contract in exercise.h.
// </solution>
#include <cmath>
#include <cstdio>

#include "exercise.h"

Eigen::Vector2d rotated(const Eigen::Vector2d& p, double angle) {
  // <solution rotated>
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  return {c * p.x() - s * p.y(), s * p.x() + c * p.y()};
  // <todo>
  //| // TODO: the point `p` turned by `angle`, counter-clockwise.
  //| return Eigen::Vector2d::Zero();
  // </solution>
}

int main() {
  for (int k = 0; k < 4; ++k) {
    const Eigen::Vector2d q = rotated({1, 0}, k * 0.5);
    std::printf("turned by %.1f rad: (%6.3f, %6.3f)\n", k * 0.5, q.x(), q.y());
  }
}
