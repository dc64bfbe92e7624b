#include <vector>

#include "exercise.h"
Eigen::Vector2d rotated(const Eigen::Vector2d& p, double) {
  std::vector<double> values = {p.x(), p.y()};
  double sum = 0;
  for (int k = 0; k < 2000000; ++k) sum += values[k];
  return {sum, sum};
}
int main() {}
