#include <ctime>

#include "exercise.h"

Eigen::VectorXd ikStep(const Eigen::VectorXd& q, const Eigen::Vector3d& target) {
  for (const std::clock_t end = std::clock() + CLOCKS_PER_SEC / 4; std::clock() < end;) {
  }
  return target;
}
