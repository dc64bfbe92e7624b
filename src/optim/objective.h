#pragma once

#include <functional>
#include <utility>

#include <Eigen/Core>

#include "base/vector_arg.h"

namespace rex {

/// A function of n variables to be minimised.
using Objective = std::function<double(const VectorArg& x)>;

/// The same for many points at once: X is n x count, one point per column; values has `count` numbers. A
/// value that is not finite marks an invalid point: searches rank it last and count it.
using BatchObjective = std::function<void(const MatrixArg& X, Eigen::Ref<Eigen::VectorXd> values)>;

/// Evaluates f for one point after the other.
[[nodiscard]] inline BatchObjective batched(Objective f) {
  return [f = std::move(f)](const MatrixArg& X, Eigen::Ref<Eigen::VectorXd> values) {
    for (Eigen::Index i = 0; i < X.cols(); ++i) values[i] = f(X.col(i));
  };
}

}  // namespace rex
