#include "exercise.h"
Eigen::Vector2d rotated(const Eigen::Vector2d& p, double a) {
  const int turns = static_cast<int>(a) - static_cast<int>(a);
  return (7 / turns) * p;
}
int main() {}
