#include <limits>

#include <fmt/format.h>

#include "base/error.h"
#include "base/require.h"
#include "optim/search_checks_internal.h"

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
