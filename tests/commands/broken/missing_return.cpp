#include "exercise.h"
Eigen::Vector2d rotated(const Eigen::Vector2d& p, double a) {
  if (a > 10) return p;
}
int main() {}
