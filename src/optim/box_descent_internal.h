#pragma once

#include <functional>

#include "base/require.h"

namespace rex::internal {

/// A function's value at x (n), and its gradient there.
using ValueAndGradient = std::function<double(const Eigen::VectorXd& x, Eigen::VectorXd& gradient)>;

struct BoxMinimum {
  Eigen::VectorXd x{};
  double value = 0;
  int evaluations = 0;
};

/// A local minimum of f within low <= x <= high, by BFGS steps that are projected onto the box (Bertsekas,
/// 1982). Ends when no coordinate that is free to move has a gradient above `tolerance`, when steps do not
/// lower f, or after maxEvaluations. f must be finite at the start, which is moved into the box.
[[nodiscard]] BoxMinimum minimizeInBox(const ValueAndGradient& f, const Eigen::VectorXd& start,
                                       const Eigen::VectorXd& low, const Eigen::VectorXd& high,
                                       double tolerance, int maxEvaluations);

}  // namespace rex::internal
