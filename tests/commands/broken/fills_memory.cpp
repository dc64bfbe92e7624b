#include <vector>

#include "exercise.h"
std::vector<double> halves(double angle) {
  std::vector<double> angles;
  while (angle == angle) angles.push_back(angle /= 2);
  return angles;
}
Eigen::Vector2d rotated(const Eigen::Vector2d& p, double angle) { return halves(angle).back() * p; }
int main() {}
