#pragma once

#include <functional>
#include <string>

#include <Eigen/Core>

namespace rex {

using VectorFunction = std::function<Eigen::VectorXd(const Eigen::VectorXd&)>;

/// Jacobian of f at x by central differences with one Richardson extrapolation: d x n, with a relative
/// error of about 1e-10 for smooth functions of scale one. `step` is the larger of the two steps, relative
/// to max(1, |x_i|). Throws Error if the size of f changes or f returns numbers that are not finite.
[[nodiscard]] Eigen::MatrixXd numericJacobian(const VectorFunction& f, const Eigen::VectorXd& x,
                                              double step = 1e-3);

/// The result of checkJacobian: the entry with the largest error, and a sentence about it.
struct JacobianCheck {
  bool ok = false;
  double error = 0;  ///< of that entry, divided by max(1, |numeric|)
  int row = 0, column = 0;
  double given = 0, numeric = 0;
  std::string message = "checkJacobian has not run";
};

/// Compares J, which should be the Jacobian of f at x, with numericJacobian. It is ok if every entry is
/// finite and within `tolerance` (relative above one, absolute below). A wrong shape is a failed check.
/// Throws as numericJacobian.
[[nodiscard]] JacobianCheck checkJacobian(const VectorFunction& f, const Eigen::MatrixXd& J,
                                          const Eigen::VectorXd& x, double tolerance = 1e-6);

}  // namespace rex
