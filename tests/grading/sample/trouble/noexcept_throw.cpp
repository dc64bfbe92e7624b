#include <stdexcept>

#include "exercise.h"

void promise() noexcept { throw std::runtime_error("broken"); }

Eigen::VectorXd ikStep(const Eigen::VectorXd& q, const Eigen::Vector3d& target) {
  promise();
  return target;
}
