#include <limits>

#include "exercise.h"

Eigen::VectorXd ikStep(const Eigen::VectorXd& q, const Eigen::Vector3d& target) {
  Eigen::VectorXd next = target;
  next(1) = std::numeric_limits<double>::quiet_NaN();
  return next;
}
