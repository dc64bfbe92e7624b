#include "exercise.h"

char large[3ull << 29];

Eigen::VectorXd ikStep(const Eigen::VectorXd& q, const Eigen::Vector3d& target) {
  return target * large[q.size()];
}
