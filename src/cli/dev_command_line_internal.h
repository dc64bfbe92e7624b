#pragma once

#include "cli/command_line_internal.h"

namespace rex::cli {

/// `rex dev new`, `check`, `strip`, `release` and `stats`.
void addDev(CLI::App& program, Action& action);

}  // namespace rex::cli
