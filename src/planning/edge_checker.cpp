#include "planning/edge_checker.h"

#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "base/error.h"
#include "planning/spread_check_internal.h"

namespace rex {

EdgeChecker::EdgeChecker(const Space& space, AllValid allValid, double resolution)
    : space_(space),
      allValid_(std::move(allValid)),
      resolution_(resolution),
      block_(space.size(), internal::kBlock) {
  if (!(resolution > 0) || !std::isfinite(resolution)) {
    throw Error({.what = "resolution of a path check",
                 .found = fmt::format("{:g}", resolution),
                 .wanted = "a positive, finite distance"});
  }
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
