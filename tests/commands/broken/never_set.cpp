#include "exercise.h"
Eigen::Vector2d rotated(const Eigen::Vector2d& p, double angle) {
  Eigen::MatrixXd R(2, 2);
  R(0, 0) = R(1, 1) = std::cos(angle);
  R(1, 0) = std::sin(angle);
  return R * p;
}
int main() {}
