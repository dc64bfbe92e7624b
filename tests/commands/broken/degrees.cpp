#include "exercise.h"
Eigen::Vector2d rotated(const Eigen::Vector2d& p, double angle) {
  angle *= 3.14159265358979 / 180;
  return {std::cos(angle) * p.x() - std::sin(angle) * p.y(), std::sin(angle) * p.x() + std::cos(angle) * p.y()};
}
int main() {}
