#include "exercise.h"

Eigen::VectorXd ikStep(const Eigen::VectorXd& q, const Eigen::Vector3d& target) {
  for (volatile bool on = true; on;) {
  }
  return target;
}
