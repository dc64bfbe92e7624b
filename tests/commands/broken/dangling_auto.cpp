#include "exercise.h"
Eigen::Vector2d rotated(const Eigen::Vector2d& p, double angle) {
  Eigen::MatrixXd R(2, 2);
  R << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle);
  auto q = R * Eigen::VectorXd(2 * p);
  if (q.rows() > 2) return p;
  return R * p;
}
int main() {}
