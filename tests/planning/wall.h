#pragma once

#include <cmath>

#include "planning/path_problem.h"

namespace rex {

/// The unit cube of that dimension with a wall at 0.45 <= x0 <= 0.55, which has a hole where all other
/// numbers are less than gap / 2 from 0.5. From (0.1, ..., 0.1) to (0.9, 0.1, ..., 0.1).
inline PathProblem wallWithHole(int dimension, double gap) {
  const auto isValid = [gap](const VectorArg& q) {
    if (q.minCoeff() < 0 || q.maxCoeff() > 1) return false;
    if (q[0] < .45 || q[0] > .55) return true;
    return (q.tail(q.size() - 1).array() - .5).abs().maxCoeff() < gap / 2;
  };
  Eigen::VectorXd start = Eigen::VectorXd::Constant(dimension, .1), goal = start;
  goal[0] = .9;
  return {.space = Space::box(Eigen::VectorXd::Zero(dimension), Eigen::VectorXd::Ones(dimension)),
          .allValid = eachColumn(isValid),
          .start = start,
          .goal = goal,
          .resolution = .005};
}

}  // namespace rex
