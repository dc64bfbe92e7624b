#pragma once

#include <functional>

#include <Eigen/Core>

#include "base/vector_arg.h"

namespace rex {

/// A linear Gaussian model y ~ N(C x + c, W): either of the next state given the state (A, a, Q) or of the
/// observation given the state (C, c, W). Slide 7:26.
struct LinearModel {
  Eigen::MatrixXd C{};  ///< m x n
  Eigen::VectorXd c{};  ///< m
  Eigen::MatrixXd W{};  ///< m x m, the covariance of the noise
};

/// Throws Error for sizes that do not fit together or a state of size n, and a W that is not a covariance;
/// `what` names the model.
void requireModel(const char* what, const LinearModel& model, Eigen::Index n);

/// y ~ N(g(x), W). Slide 7:28.
struct NonlinearModel {
  std::function<Eigen::VectorXd(const Eigen::VectorXd& x)> g{};
  /// The Jacobian of g at x, m x n. Empty: central differences with one extrapolation (numericJacobian).
  std::function<Eigen::MatrixXd(const Eigen::VectorXd& x)> jacobian{};
  Eigen::MatrixXd W{};
  /// y1 - y2 if values of g are or contain angles. Empty: the plain difference.
  std::function<Eigen::VectorXd(const Eigen::VectorXd& y1, const Eigen::VectorXd& y2)> difference{};
};

/// y1 - y2 as the model defines it. Throws Error for sizes that differ and numbers that are not finite.
[[nodiscard]] Eigen::VectorXd difference(const NonlinearModel& model, const Eigen::VectorXd& y1,
                                         const Eigen::VectorXd& y2);

/// The model linearised at x: C = jacobian, C x + c = g(x). Throws Error for a model without g, values that
/// are not finite, and as requireModel.
[[nodiscard]] LinearModel linearized(const NonlinearModel& model, const VectorArg& x);

}  // namespace rex
