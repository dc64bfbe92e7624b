#include "exercise.h"

Eigen::VectorXd ikStep(const Eigen::VectorXd& q, const Eigen::Vector3d& target) {
  volatile char frame[4096];
  frame[0] = 1;
  const Eigen::VectorXd deeper = ikStep(target, q.head<3>());
  return deeper * frame[0];
}
