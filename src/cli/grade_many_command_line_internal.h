#pragma once

#include "cli/command_line_internal.h"

namespace rex::cli {

/// `rex grade DIR`, `rex grade-one` and `rex collect DIR`.
void addGradeMany(CLI::App& program, Action& action);

}  // namespace rex::cli
