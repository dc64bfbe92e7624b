#include "exercise.h"
Eigen::Vector2d rotated(const Eigen::Vector2d& p, double angle) {
  double a = angle;
  if (a = 0) return p;
  return {std::cos(a) * p.x() - std::sin(a) * p.y(), std::sin(a) * p.x() + std::cos(a) * p.y()};
}
int main() {}
