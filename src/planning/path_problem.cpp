#include "planning/path_problem.h"

#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "base/error.h"
#include "base/require.h"
#include "planning/path_problem_internal.h"

namespace rex {

AllValid eachColumn(std::function<bool(const VectorArg& q)> isValid) {
  return [isValid = std::move(isValid)](const MatrixArg& Q) {
    for (Eigen::Index k = 0; k < Q.cols(); ++k)
      if (!isValid(Q.col(k))) return false;
    return true;
  };
}

AllValid whereClear(std::function<double(const VectorArg& q)> clearance) {
  return eachColumn([clearance = std::move(clearance)](const VectorArg& q) {
    const double gap = clearance(q);
    if (std::isnan(gap)) {
      throw Error({.what = fmt::format("clearance at ({:.4g})", fmt::join(q.begin(), q.end(), ", ")),
                   .found = "not a number",
                   .wanted = "metres, positive where the configuration is valid"});
    }
    return gap > 0;
  });
}

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

EdgeChecker::EdgeChecker(const Space& space, AllValid allValid, double resolution)
    : space_(space),
      allValid_(std::move(allValid)),
      resolution_(resolution),
      block_(space.size(), internal::kBlock) {
  requirePositive("resolution of a path check", resolution);
}

bool EdgeChecker::isValid(const VectorArg& q) {
  ++asked_;
  return allValid_(q);
}

bool EdgeChecker::isValid(const VectorArg& from, const VectorArg& to) {
  const int points = internal::pointsOn(space_.wayLength(from, to), resolution_);
  return internal::isValidSpread(allValid_, points, block_, [&](double share, auto out) {
    ++asked_;
    space_.interpolate(from, to, share, out);
  });
}

}  // namespace rex
