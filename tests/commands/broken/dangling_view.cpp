#include "exercise.h"
Eigen::Matrix2d turn(double angle) {
  Eigen::Matrix2d R;
  R << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle);
  return R;
}
Eigen::Vector2d rotated(const Eigen::Vector2d& p, double angle) {
  auto q = turn(angle) * p;
  const auto first = turn(angle).col(0);
  const auto axis = Eigen::Vector2d::UnitX();  // refers to nothing
  auto length = p.norm() + axis.norm() + first.norm();
  if (length < 0) return p;
  return q;
}
int main() {}
