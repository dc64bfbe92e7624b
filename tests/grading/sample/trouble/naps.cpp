#include <unistd.h>

#include "exercise.h"

Eigen::VectorXd ikStep(const Eigen::VectorXd& q, const Eigen::Vector3d& target) {
  sleep(2);
  return target;
}
