#include <cstdio>
#include <string>

#include "exercise.h"

Eigen::VectorXd ikStep(const Eigen::VectorXd& q, const Eigen::Vector3d& target) {
  const std::string line(1000, 'x');
  for (int k = 0; k < 1000000; ++k) std::printf("%s\n", line.c_str());
  return target;
}
