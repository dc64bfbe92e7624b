#pragma once

#include <cstdlib>

namespace rex {

/// Whether scripts/test --long runs, which sets the variable.
inline bool isLongRun() { return std::getenv("REX_LONG_RUN") != nullptr; }

/// How often a test repeats something.
inline int rounds(int inShortRuns, int inLongRuns) { return isLongRun() ? inLongRuns : inShortRuns; }

}  // namespace rex
