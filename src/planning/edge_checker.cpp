#include "planning/edge_checker.h"

#include <utility>

#include "base/require.h"
#include "planning/spread_check_internal.h"

namespace rex {

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
