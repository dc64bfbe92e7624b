#include <algorithm>
#include <cmath>

#include "planning/plane_program_internal.h"

namespace rex::internal {
namespace {

constexpr double kRounding = 1e-12;

// Half-planes that do not involve y bound x itself.
bool isUpright(const HalfPlane& row) { return row.y == 0; }

Range uprightRange(std::span<const HalfPlane> rows, Range x) {
  for (const HalfPlane& row : rows) {
    if (!isUpright(row)) continue;
    if (row.x > 0) x.high = std::min(x.high, row.bound / row.x);
    if (row.x < 0) x.low = std::max(x.low, row.bound / row.x);
    if (row.x == 0 && row.bound < 0) x.high = -std::numeric_limits<double>::infinity();
  }
  return x;
}

// The end of the range of x on the side `sign`.
std::optional<double> extremeX(std::span<const HalfPlane> rows, const Range& xRange, const Range& yRange,
                               double sign, Slice& failed) {
  const Range x = uprightRange(rows, xRange);
  double at = sign > 0 ? x.high : x.low;
  const double end = sign > 0 ? x.low : x.high;
  failed = sliceAt(rows, yRange, at);
  if (x.low > x.high + kRounding * std::abs(x.low)) return {};
  for (std::size_t step = 0; step <= 2 * rows.size() + 2; ++step) {
    failed = sliceAt(rows, yRange, at);
    const auto& [y, low, high] = failed;
    if (y.low - y.high <= kRounding * (std::abs(y.low) + std::abs(y.high))) return at;
    const double opening = low.slope - high.slope;  // how fast the gap closes as x falls
    if (!(sign * opening > 0)) return {};
    const double next = (high.at0 - low.at0) / opening;
    if (sign * (at - next) <= 0) return at;  // the gap is only rounding
    at = next;
    if (sign * (end - at) > kRounding * (std::abs(end) + std::abs(at))) return {};
    if (sign * (end - at) > 0) at = end;
  }
  return at;
}

}  // namespace

Slice sliceAt(std::span<const HalfPlane> rows, const Range& yRange, double x) {
  Slice slice{.y = yRange, .low = {.at0 = yRange.low}, .high = {.at0 = yRange.high}};
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const HalfPlane& row = rows[i];
    if (isUpright(row)) continue;
    const BoundingLine line{row.bound / row.y, -row.x / row.y, static_cast<int>(i)};
    const double y = line.at0 + line.slope * x;
    if (row.y > 0 && y < slice.y.high) {
      slice.y.high = y;
      slice.high = line;
    } else if (row.y < 0 && y > slice.y.low) {
      slice.y.low = y;
      slice.low = line;
    }
  }
  return slice;
}

std::optional<double> largestX(std::span<const HalfPlane> rows, const Range& xRange, const Range& yRange,
                               Slice& failed) {
  return extremeX(rows, xRange, yRange, 1, failed);
}

std::optional<double> smallestX(std::span<const HalfPlane> rows, const Range& xRange, const Range& yRange,
                                Slice& failed) {
  return extremeX(rows, xRange, yRange, -1, failed);
}

}  // namespace rex::internal
