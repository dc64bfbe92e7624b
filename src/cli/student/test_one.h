#pragma once

#include "base/exit_code.h"
#include "cli/project.h"
#include "cli/student/test_run.h"

namespace rex::cli {

/// Grades one exercise and prints the result.
ExitCode testOne(const Project& project, const TestOptions& options);

}  // namespace rex::cli
