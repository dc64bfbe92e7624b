#pragma once

#include "base/exit_code.h"
#include "cli/project.h"

namespace rex::cli {

/// The points of the last test of each exercise, and what to do next.
ExitCode progress(const Project& project);

}  // namespace rex::cli
