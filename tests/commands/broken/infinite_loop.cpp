#include "exercise.h"
Eigen::Vector2d rotated(const Eigen::Vector2d& p, double a) {
  double angle = a;
  while (angle == angle) angle += 1;
  return angle * p;
}
int main() {}
