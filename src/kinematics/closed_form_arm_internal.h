#pragma once

#include <array>

namespace rex::internal {

/// Up to four angles in (-pi, pi].
struct Angles {
  std::array<double, 4> angle{};
  int count = 0;

  void add(double one) {
    if (count < 4) angle[static_cast<std::size_t>(count++)] = one;
  }
  const double* begin() const { return angle.data(); }
  const double* end() const { return angle.data() + count; }
};

/// The angles at which a cos x + b sin x = d: two, or one where rounding parts them, or none. None as well if
/// a and b are less than `least`, where every angle or no angle is one.
[[nodiscard]] Angles rootsOfLine(double a, double b, double d, double least);

/// The angles at which a sum of 1, cos x, sin x, cos 2x, sin 2x is zero, given its values at the multiples 0
/// to 7 of pi / 4. Where the graph only touches zero, to `tolerance` relative to the largest of these, the
/// root is double.
[[nodiscard]] Angles rootsOfSecondOrder(const std::array<double, 8>& values, double tolerance);

}  // namespace rex::internal
