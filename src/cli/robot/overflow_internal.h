#pragma once

#include "cli/terminal.h"

namespace rex::cli {

/// Says so where an answer has numbers that are too large for a double.
inline void noteOverflow(bool isFinite) {
  if (!isFinite) note("warning: some numbers are too large to compute with: inf and nan, in JSON null");
}

}  // namespace rex::cli
