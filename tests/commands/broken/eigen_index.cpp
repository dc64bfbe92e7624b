#include "exercise.h"
Eigen::Vector2d rotated(const Eigen::Vector2d& p, double) {
  Eigen::VectorXd q = p;
  q(2) = 1;
  return q.head(2);
}
int main() {}
