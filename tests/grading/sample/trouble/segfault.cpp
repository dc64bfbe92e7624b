#include "exercise.h"

Eigen::VectorXd ikStep(const Eigen::VectorXd& q, const Eigen::Vector3d& target) {
  volatile int* nowhere = nullptr;
  *nowhere = 1;
  return target;
}
