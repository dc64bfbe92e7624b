#include "exercise.h"
Eigen::Vector2d rotated(const Eigen::Vector2d& p, double angle) {
  Eigen::VectorXd sines(3);
  sines << std::sin(angle), std::cos(angle), 0;
  const Eigen::VectorXd sum = sines + p;
  return sum.head(2);
}
int main() {}
