#pragma once

#include <algorithm>
#include <cmath>

#include "base/require.h"

namespace rex::grading {

/// 1 + the largest |entry| of a value, for a tolerance relative to its size. A value that depends on an
/// answer, such as one step from a state of the student's, counts up to `most`: an answer makes a tolerance
/// smaller, never larger than that. Wanted values that depend on inputs alone need no such limit.
[[nodiscard]] inline double sizeUpTo(double most, double value) {
  return std::min(1 + std::abs(value), most);
}
[[nodiscard]] inline double sizeUpTo(double most, const MatrixArg& value) {
  return sizeUpTo(most, value.size() == 0 ? 0. : value.cwiseAbs().maxCoeff());
}

}  // namespace rex::grading
