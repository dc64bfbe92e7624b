#include <vector>

#include "exercise.h"
Eigen::Vector2d rotated(const Eigen::Vector2d& p, double) {
  const std::vector<double> all(1250000000, 1.0);
  return all[7] * p;
}
int main() {}
