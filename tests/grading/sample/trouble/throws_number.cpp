#include "exercise.h"

Eigen::VectorXd ikStep(const Eigen::VectorXd& q, const Eigen::Vector3d& target) {
  if (target.size() == 3) throw 42;
  return target;
}
