#pragma once

#include <vector>

#include "base/exit_code.h"
#include "cli/project.h"
#include "cli/student/test_run.h"

namespace rex::cli {

/// Grades several exercises, `jobs` at once (0: one per processor), and reports them in the given order. In
/// `each`, `out` gets a folder for every exercise; main and checks belong to a single exercise and are
/// refused. Returns the largest exit code: a grader error (also if it does not build), then not gradable,
/// then below full score.
ExitCode testMany(const Project& project, const std::vector<ExerciseInfo>& exercises, const TestOptions& each,
                  int jobs);

}  // namespace rex::cli
