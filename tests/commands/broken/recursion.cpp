#include "exercise.h"
Eigen::Vector2d rotated(const Eigen::Vector2d& p, double a) {
  const Eigen::Vector2d half = rotated(p, a / 2);
  return half + p;
}
int main() {}
