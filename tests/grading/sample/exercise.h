#pragma once

#include <functional>

#include <Eigen/Core>

struct Reached {
  Eigen::VectorXd q;
  double distance = 0;  // metres
};

/// Moves the three joints to the target: q of size 3 in radians, target in metres. Trouble happens here.
Eigen::VectorXd ikStep(const Eigen::VectorXd& q, const Eigen::Vector3d& target);

/// x * x.
double square(double x);

/// The same as a search that asks the world how far it is.
Reached search(const Eigen::VectorXd& q, const std::function<double(const Eigen::VectorXd&)>& distance);
