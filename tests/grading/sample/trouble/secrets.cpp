#include <iostream>
#include <stdexcept>

#include "exercise.h"

Eigen::VectorXd ikStep(const Eigen::VectorXd& q, const Eigen::Vector3d& target) {
  std::cout << "the target is " << target.transpose() << '\n';
  throw std::runtime_error("the target is " + std::to_string(target.x()));
}
