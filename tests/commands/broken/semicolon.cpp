#include "exercise.h"
Eigen::Vector2d rotated(const Eigen::Vector2d& p, double) {
  const double c = 1
  return c * p;
}
int main() {}
