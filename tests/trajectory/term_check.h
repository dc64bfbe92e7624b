#pragma once

#include "base/derivative_check.h"
#include "trajectory/trajectory_optimizer.h"

namespace rex {

/// Value and Jacobian of a term at a window (n x (k + 1)).
inline FunctionValue valueOf(const TrajectoryTerm& term, const Eigen::MatrixXd& X, double tau, int t = 7) {
  FunctionValue value;
  term.function({.t = t, .tau = tau, .X = X}, value);
  return value;
}

/// Compares the term's Jacobian there with differences.
inline JacobianCheck checkTerm(const TrajectoryTerm& term, const Eigen::MatrixXd& X, double tau) {
  const auto f = [&](const Eigen::VectorXd& x) {
    return valueOf(term, x.reshaped(X.rows(), X.cols()), tau).y;
  };
  return checkJacobian(f, valueOf(term, X, tau).J, X.reshaped());
}

}  // namespace rex
