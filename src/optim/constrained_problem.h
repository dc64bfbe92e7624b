#pragma once

#include <functional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "base/vector_arg.h"

namespace rex {

/// The value y (d) of a smooth function at a point, and its Jacobian J (d x n).
struct FunctionValue {
  Eigen::VectorXd y;
  Eigen::MatrixXd J;
};
using SmoothFunction = std::function<FunctionValue(const VectorArg& x)>;

/// Minimise f(x)^T f(x) + c(x) subject to g(x) <= 0 and h(x) = 0 (slide 5:3, without time). Any of the
/// functions may be empty.
struct ConstrainedProblem {
  SmoothFunction residuals{};     ///< f
  SmoothFunction cost{};          ///< c, one number
  SmoothFunction inequalities{};  ///< g
  SmoothFunction equalities{};    ///< h
  /// Names of the rows of g and h in messages; other rows are numbered: "inequality 3".
  std::vector<std::string> inequalityNames{}, equalityNames{};
};

}  // namespace rex
