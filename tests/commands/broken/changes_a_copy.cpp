#include "exercise.h"
void turn(Eigen::Vector2d p, double a) {
  p = Eigen::Vector2d(std::cos(a) * p.x() - std::sin(a) * p.y(), std::sin(a) * p.x() + std::cos(a) * p.y());
}
Eigen::Vector2d rotated(const Eigen::Vector2d& p, double angle) {
  Eigen::Vector2d q = p;
  turn(q, angle);
  return q;
}
int main() {}
