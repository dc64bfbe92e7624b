#include "exercise.h"
Eigen::Vector2d rotated(const Eigen::Vector2d& p, double a) {
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
  R(0, 0) = a;
  return R * p;
}
int main() {}
