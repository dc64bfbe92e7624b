#pragma once

#include <Eigen/Core>

namespace rex::internal {

/// e^M of a square matrix.
[[nodiscard]] Eigen::MatrixXd exponential(const Eigen::MatrixXd& M);

}  // namespace rex::internal
