#pragma once

#include <vector>

#include "base/exit_code.h"
#include "cli/project.h"
#include "cli/student/test_run.h"

namespace rex::cli {

/// Grades several at the same time, `jobs` at once (0: one per processor), and reports each in the given
/// order. In `each`, `out` gets a folder for every exercise; main and checks belong to one and are refused.
/// Of the exit codes the largest: a fault of the grader, also one that does not build, then what cannot be
/// graded, then what is below full score.
ExitCode testMany(const Project& project, const std::vector<ExerciseInfo>& exercises, const TestOptions& each,
                  int jobs);

}  // namespace rex::cli
