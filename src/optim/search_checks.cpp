#include <cmath>
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
  const auto count = static_cast<double>(start.size());
  requireSearchOption(count > 0, search, "coordinates of the start", count, "1 or more");
  requireFinite(fmt::format("{}: start", search), start);
  requireSearchOption(std::isfinite(deviation) && deviation > 0, search, "deviation of steps", deviation,
                      "a positive, finite number");
  requireSearchOption(target < std::numeric_limits<double>::infinity(), search, "target", target,
                      "a number below infinity");
  requireSearchOption(maxEvaluations > 0, search, "budget of evaluations",
                      static_cast<double>(maxEvaluations), "1 or more");
}

}  // namespace rex::internal
