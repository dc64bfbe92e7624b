#include "exercise.h"
Eigen::Vector2d rotated(const Eigen::Vector2d& p, double angle) {
  const double s = std::sin(angle), c = 1 / 2 * std::cos(angle);
  return {2 * c * p.x() - s * p.y(), s * p.x() + 2 * c * p.y()};
}
int main() {}
