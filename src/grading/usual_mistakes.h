#pragma once

#include <string>
#include <string_view>

#include "base/require.h"

namespace rex::grading {

/// A sentence about the one usual mistake that explains a wrong value: the opposite sign, transposed, degrees
/// for radians, one step off, first two entries exchanged, in reverse order, a constant factor. Empty if
/// none does: the value put right must be within `tolerance` of the wanted one, or within 1e-9 of its size,
/// and the tolerance so small that this is no accident. Both are finite and have the same shape, or one that
/// of the other transposed.
[[nodiscard]] std::string usualMistake(const MatrixArg& got, const MatrixArg& wanted, double tolerance,
                                       std::string_view unit = "");

/// A sentence about the first number that hardly any computation gives: not finite, or beyond 1e150.
/// Student builds fill what is never set with such numbers. Empty if there is none.
[[nodiscard]] std::string strangeNumber(const MatrixArg& got);

}  // namespace rex::grading
