#pragma once

#include <limits>
#include <optional>
#include <span>

namespace rex::internal {

/// The points (X, Y) of a plane with x * X + y * Y <= bound.
struct HalfPlane {
  double y = 0, x = 0, bound = 0;
};

struct Range {
  double low = 0, high = 0;
};

/// A line y = at0 + slope * x that bounds y, and the half-plane it belongs to; -1: the range of y.
struct BoundingLine {
  double at0 = 0, slope = 0;
  int row = -1;
};

/// What half-planes and the range leave of y at x: low and high, which cross where nothing is left.
struct Slice {
  Range y{};
  BoundingLine low{}, high{};
};
[[nodiscard]] Slice sliceAt(std::span<const HalfPlane> rows, const Range& yRange, double x);

/// The linear program of two variables: the largest x (or the smallest) within xRange for which there is a y.
/// What is left of y is concave in x, so that Newton's method, started outside, reaches the exact answer in
/// finitely many steps. If none: `failed` gets the slice at which that was seen. Allocates nothing.
[[nodiscard]] std::optional<double> largestX(std::span<const HalfPlane> rows, const Range& xRange,
                                             const Range& yRange, Slice& failed);
[[nodiscard]] std::optional<double> smallestX(std::span<const HalfPlane> rows, const Range& xRange,
                                              const Range& yRange, Slice& failed);

}  // namespace rex::internal
