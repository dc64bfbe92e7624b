#pragma once

#include <Eigen/Core>

namespace rex {

/// Vectors and matrices as arguments: passed without a copy, including columns and blocks.
using VectorArg = Eigen::Ref<const Eigen::VectorXd>;
using MatrixArg = Eigen::Ref<const Eigen::MatrixXd>;

}  // namespace rex
