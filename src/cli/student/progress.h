#pragma once

#include "base/exit_code.h"
#include "cli/project.h"

namespace rex::cli {

/// Prints the points of the last test of each exercise, and what to do next.
ExitCode progress(const Project& project);

}  // namespace rex::cli
