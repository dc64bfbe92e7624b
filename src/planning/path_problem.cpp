#include "planning/path_problem.h"

#include "base/error.h"

namespace rex {

void requireSound(const PathProblem& problem) {
  const auto require = [&](const char* what, const Eigen::VectorXd& q) {
    problem.space.require(what, q);
    if (problem.allValid(q)) return;
    throw Error({.what = what,
                 .found = problem.reason ? problem.reason(q) : "a configuration that is not valid",
                 .wanted = "a valid one"});
  };
  require("start", problem.start);
  require("goal", problem.goal);
}

double pathLength(const Space& space, const MatrixArg& path) {
  double length = 0;
  for (Eigen::Index k = 1; k < path.cols(); ++k) length += space.distance(path.col(k - 1), path.col(k));
  return length;
}

double lengthThrough(const Space& space, const VectorArg& a, const VectorArg& via, const VectorArg& b) {
  return space.distance(a, via) + space.distance(via, b);
}

}  // namespace rex
