#include "planning/edge_checker.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include <fmt/format.h>

#include "base/error.h"

namespace rex {
namespace {

constexpr int kBlock = 8;
constexpr double kMostPoints = 1e8;  // on one way: minutes of work even where a check takes a microsecond

// A step that visits all of 0 .. count - 1 and never stays near where it was: coprime to count, about .38 of
// it.
int wideStep(int count) {
  int step = std::max(1, static_cast<int>(.382 * count));
  while (std::gcd(step, count) != 1) ++step;
  return step;
}

}  // namespace

EdgeChecker::EdgeChecker(const Space& space, AllValid allValid, double resolution)
    : space_(space), allValid_(std::move(allValid)), resolution_(resolution), block_(space.size(), kBlock) {
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

int EdgeChecker::pointsBetween(const VectorArg& from, const VectorArg& to) const {
  const double distance = space_.wayLength(from, to), points = std::ceil(distance / resolution_);
  if (points <= kMostPoints) return std::max(1, static_cast<int>(points));
  throw Error(
      {.what = fmt::format("resolution of a path check: {:g} on a way of length {:g}", resolution_, distance),
       .found = std::isfinite(distance) ? fmt::format("{:g} points", points) : "no finite distance",
       .wanted = fmt::format("a coarser one: at most {:g} points", kMostPoints)});
}

bool EdgeChecker::isValid(const VectorArg& from, const VectorArg& to) {
  const int points = pointsBetween(from, to);
  const int blocks = (points + kBlock - 1) / kBlock, step = wideStep(blocks);
  for (int i = 0, first = 0; i < blocks; ++i, first = (first + step) % blocks) {
    int filled = 0;
    for (int k = points - first; k > 0; k -= blocks)  // the end belongs to the first block
      space_.interpolate(from, to, static_cast<double>(k) / points, block_.col(filled++));
    asked_ += filled;
    if (!allValid_(block_.leftCols(filled))) return false;
  }
  return true;
}

}  // namespace rex
