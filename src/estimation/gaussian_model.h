#pragma once

#include <functional>

#include <Eigen/Core>

#include "base/vector_arg.h"

namespace rex {

/// y ~ N(C x + c, W): how one quantity follows from another, be it the next state from the state (A, a, Q) or
/// the observation from the state (C, c, W). Slide 7:26.
struct LinearModel {
  Eigen::MatrixXd C{};  ///< m x n
  Eigen::VectorXd c{};  ///< m
  Eigen::MatrixXd W{};  ///< m x m, the covariance of the noise
};

/// Throws Error for sizes that do not fit together or do not take a state of n numbers, and a W that is no
/// covariance; `what` names the model.
void requireModel(const char* what, const LinearModel& model, Eigen::Index n);

/// y ~ N(g(x), W). Slide 7:28.
struct NonlinearModel {
  std::function<Eigen::VectorXd(const Eigen::VectorXd& x)> g{};
  /// Of g at x, m x n. Empty: central differences with one extrapolation (numericJacobian).
  std::function<Eigen::MatrixXd(const Eigen::VectorXd& x)> jacobian{};
  Eigen::MatrixXd W{};
  /// y1 - y2 where values of g are angles or have some. Empty: the plain difference.
  std::function<Eigen::VectorXd(const Eigen::VectorXd& y1, const Eigen::VectorXd& y2)> difference{};
};

/// y1 - y2 as the model says. Throws Error for sizes that differ, and what is not finite.
[[nodiscard]] Eigen::VectorXd difference(const NonlinearModel& model, const Eigen::VectorXd& y1,
                                         const Eigen::VectorXd& y2);

/// The model along the tangent at x: C = jacobian, C x + c = g(x). Throws Error for a model without g, values
/// that are not finite, and as requireModel.
[[nodiscard]] LinearModel linearized(const NonlinearModel& model, const VectorArg& x);

}  // namespace rex
