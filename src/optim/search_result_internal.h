#pragma once

#include "base/require.h"

namespace rex::internal {

/// Throws Error naming `search` for a start without numbers or with some that are not finite, a deviation
/// that is not positive and finite, a target that is infinity or not a number, and a budget below one.
void requireSearch(const char* search, const VectorArg& start, double deviation, double target,
                   long maxEvaluations);

/// Throws Error "search: what: found number, wanted ..." unless isRight.
void requireSearchOption(bool isRight, const char* search, const char* what, double number,
                         const char* wanted);

}  // namespace rex::internal
