#include "trajectory/trajectory_optimizer.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "base/error.h"
#include "base/require.h"
#include "trajectory/banded_system_internal.h"

namespace rex {
namespace {

[[noreturn]] void refuse(const TrajectoryTerm& term, const char* part, std::string found,
                         std::string wanted) {
  throw Error({.what = fmt::format("term '{}': {}", term.name, part),
               .found = std::move(found),
               .wanted = std::move(wanted)});
}

void requireUsable(const TrajectoryTerm& term, long reach, int steps) {
  if (!term.function) refuse(term, "function", "none", "one");
  if (term.order < 0 || term.order > reach)
    refuse(term, "order", fmt::format("{}", term.order),
           fmt::format("0 to {}, the length of the prefix", reach));
  const int last = term.last.value_or(steps - 1);
  if (term.first < 0 || last >= steps || last < term.first)
    refuse(term, "steps", fmt::format("{} to {}", term.first, last),
           fmt::format("a range within 0 to {}", steps - 1));
}

}  // namespace

TrajectoryTerm during(TrajectoryTerm term, int first, int last) {
  term.first = first;
  term.last = last;
  return term;
}

TrajectoryTerm at(TrajectoryTerm term, int t) { return during(std::move(term), t, t); }

TrajectoryTerm as(TermKind kind, TrajectoryTerm term) {
  term.kind = kind;
  return term;
}

TrajectoryProblem::TrajectoryProblem(std::vector<TrajectoryTerm> terms, const MatrixArg& prefix, int steps,
                                     double tau)
    : terms_(std::move(terms)), prefix_(prefix), steps_(steps), tau_(tau) {
  if (prefix.size() == 0 || !prefix.allFinite())
    throw Error({.what = "prefix of a trajectory",
                 .found = prefix.size() == 0 ? "no numbers" : "a number that is not finite",
                 .wanted = "one finite configuration or more, one per column"});
  requireCount("steps of a trajectory", steps, 1);
  requirePositive("time of a step", tau, kSeconds);
  for (const TrajectoryTerm& term : terms_) requireUsable(term, prefix.cols(), steps);
}

int TrajectoryProblem::order() const {
  int order = 0;
  for (const TrajectoryTerm& term : terms_) order = std::max(order, term.order);
  return order;
}

namespace {

// The largest share of a limit in a matrix of differences.
double largestShare(const Eigen::MatrixXd& differences, const Eigen::VectorXd& limit, const char* what) {
  if (limit.size() == 0 || differences.cols() == 0) return 0;
  requireSize(what, limit.size(), differences.rows());
  for (const double number : limit) requirePositiveOrInfinite(what, number);
  return (differences.array().abs().colwise() / limit.array()).maxCoeff();
}

}  // namespace

TrajectoryResult optimizeTrajectory(const TrajectoryProblem& problem, const MatrixArg& start,
                                    const ConstrainedOptions& options) {
  if (start.rows() != problem.n() || start.cols() != problem.steps())
    throw Error({.what = "start of a trajectory",
                 .found = fmt::format("{} x {}", start.rows(), start.cols()),
                 .wanted = fmt::format("{} x {}", problem.n(), problem.steps())});
  internal::BandedSystem system(problem);
  TrajectoryResult result;
  result.solution = solveConstrained(system, Eigen::VectorXd(start.reshaped()), options);
  result.X = result.solution.x.reshaped(problem.n(), problem.steps());
  return result;
}

Eigen::MatrixXd straightTrajectory(const VectorArg& from, const VectorArg& to, int steps) {
  requireSize("end of a straight trajectory", to.size(), from.size());
  requireCount("steps of a trajectory", steps, 1);
  Eigen::MatrixXd X(from.size(), steps);
  for (int t = 0; t < steps; ++t) X.col(t) = from + (to - from) * ((t + 1.) / steps);
  return X;
}

double shortestTau(const MatrixArg& path, const Eigen::VectorXd& velocityLimit,
                   const Eigen::VectorXd& accelerationLimit) {
  const Eigen::Index N = path.cols();
  Eigen::MatrixXd once(path.rows(), std::max<Eigen::Index>(0, N - 1)),
      twice(path.rows(), std::max<Eigen::Index>(0, N - 2));
  if (N > 1) once = path.rightCols(N - 1) - path.leftCols(N - 1);
  if (N > 2) twice = once.rightCols(N - 2) - once.leftCols(N - 2);
  return std::max(largestShare(once, velocityLimit, "velocity limits"),
                  std::sqrt(largestShare(twice, accelerationLimit, "acceleration limits")));
}

}  // namespace rex
