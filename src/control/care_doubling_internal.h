#pragma once

#include <optional>

#include "control/riccati.h"

namespace rex::internal {

/// solveCare() for problems that are easy to solve, many times as fast: structure-preserving doubling (Chu,
/// Fan and Lin 2005), then Newton steps with residuals in extended precision. Sizes and numbers are sound.
/// Empty where it does not converge quickly to an X whose closed loop is safely stable.
[[nodiscard]] std::optional<RiccatiResult> careByDoubling(const MatrixArg& A, const MatrixArg& B,
                                                          const MatrixArg& Q, const MatrixArg& R);

}  // namespace rex::internal
