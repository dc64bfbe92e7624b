#pragma once

#include <functional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "base/vector_arg.h"

namespace rex {

/// Value y (d) of a smooth function at a point, and its Jacobian J there (d x n).
struct FunctionValue {
  Eigen::VectorXd y;
  Eigen::MatrixXd J;
};
using SmoothFunction = std::function<FunctionValue(const VectorArg& x)>;

/// Minimise f(x)^T f(x) + c(x) such that g(x) <= 0 and h(x) = 0 (slide 5:3, without time). Functions that are
/// empty are not there.
struct ConstrainedProblem {
  SmoothFunction residuals{};     ///< f
  SmoothFunction cost{};          ///< c, one number
  SmoothFunction inequalities{};  ///< g
  SmoothFunction equalities{};    ///< h
  /// What to call the rows of g and h in messages; rows beyond have numbers: "inequality 3".
  std::vector<std::string> inequalityNames{}, equalityNames{};
};

}  // namespace rex
