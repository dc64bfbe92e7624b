#include "optim/search_result.h"

#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "base/error.h"
#include "base/require.h"
#include "optim/search_result_internal.h"

namespace rex {

const char* toString(SearchStatus status) {
  switch (status) {
    case SearchStatus::kTargetReached:
      return "target reached";
    case SearchStatus::kBudgetSpent:
      return "budget spent";
    case SearchStatus::kSmallSteps:
      return "small steps";
    case SearchStatus::kFlat:
      return "flat";
    case SearchStatus::kNoEffect:
      return "no effect";
    case SearchStatus::kStagnated:
      return "stagnated";
    case SearchStatus::kIllConditioned:
      return "ill-conditioned";
    case SearchStatus::kDiverged:
      return "diverged";
  }
  return "";
}

void SearchResult::add(const Eigen::Ref<const Eigen::VectorXd>& point, double valueThere) {
  ++evaluations;
  if (!std::isfinite(valueThere)) {
    ++invalid;
  } else if (valueThere < value) {
    value = valueThere;
    x = point;
  }
}

void SearchResult::end(SearchStatus why) {
  status = why;
  message = fmt::format("{}: {:.6g} after {} evaluations in {} iterations", toString(why), value, evaluations,
                        iterations);
  if (invalid > 0) message += fmt::format("; {} evaluations gave no finite value", invalid);
}

}  // namespace rex

namespace rex::internal {

void requireSearchOption(bool isRight, const char* search, const char* what, double number,
                         const char* wanted) {
  if (isRight) return;
  throw Error(
      {.what = fmt::format("{}: {}", search, what), .found = fmt::format("{:g}", number), .wanted = wanted});
}

void requireSearch(const char* search, const VectorArg& start, double deviation, double target,
                   long maxEvaluations) {
  requireCount(fmt::format("{}: coordinates of the start", search), start.size(), 1);
  requireFinite(fmt::format("{}: start", search), start);
  requirePositive(fmt::format("{}: deviation of steps", search), deviation);
  requireSearchOption(target < std::numeric_limits<double>::infinity(), search, "target", target,
                      "a number below infinity");
  requireCount(fmt::format("{}: budget of evaluations", search), maxEvaluations, 1);
}

}  // namespace rex::internal
