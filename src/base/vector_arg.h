#pragma once

#include <Eigen/Core>

namespace rex {

/// Vectors and matrices as arguments: taken without a copy, columns and blocks included.
using VectorArg = Eigen::Ref<const Eigen::VectorXd>;
using MatrixArg = Eigen::Ref<const Eigen::MatrixXd>;

}  // namespace rex
