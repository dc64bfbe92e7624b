#include "trajectory/trajectory_problem.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "base/error.h"
#include "base/require.h"

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

}  // namespace rex
