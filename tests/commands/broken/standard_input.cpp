#include <iostream>

#include "exercise.h"
Eigen::Vector2d rotated(const Eigen::Vector2d& p, double) {
  double scale = 3;
  std::cin >> scale;
  return scale * p;
}
int main() {}
