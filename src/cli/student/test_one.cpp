#include "cli/student/test_one.h"

#include <algorithm>
#include <cstdio>
#include <thread>

#include "base/text_file.h"
#include "cli/progress_line.h"
#include "cli/sandbox_choice.h"
#include "cli/student/test_run.h"

namespace rex::cli {

ExitCode testOne(const Project& project, const TestOptions& options) {
  ExerciseInfo exercise = project.exercise(options.exercise);
  const std::optional<sandbox::Sandbox> sandbox = chooseSandbox(project, options.level);
  if (!sandbox) return ExitCode::kWeakSandbox;
  const TestRun run(project, std::move(exercise), options);
  // A sandbox has one work folder for all tools.
  const int processors =
      isConfined(sandbox->level) ? 1 : static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  const grading::Submission graded = [&] {
    const ProgressLine line([&] { return run.stage(); });
    return run.grade(*sandbox, processors);
  }();
  run.publish(project, graded.result);
  if (options.json)
    std::fputs(readTextFile(run.ownResults()).c_str(), stdout);
  else
    run.print(graded);
  return exitCodeOf(graded.result);
}

}  // namespace rex::cli
