#include "exercise.h"

char large[1ull << 36];

Eigen::VectorXd ikStep(const Eigen::VectorXd& q, const Eigen::Vector3d& target) {
  return target * large[q.size()];
}
