#include <algorithm>
#include <cstdio>

#include <fmt/format.h>

#include "base/error.h"
#include "cli/commands.h"
#include "cli/progress_file.h"
#include "cli/progress_line.h"
#include "cli/sandbox_choice.h"
#include "cli/student_file.h"
#include "cli/terminal.h"
#include "cli/test_report.h"
#include "grading/hidden_seed.h"
#include "grading/private_folder.h"
#include "grading/result_file.h"
#include "grading/submission.h"
#include "grading/text_file.h"

namespace rex::cli {
namespace {

using grading::GradeResult;
using grading::Outcome;

ExitCode exitCodeOf(const GradeResult& result) {
  if (result.outcome == Outcome::graderError) return ExitCode::kGraderFault;
  if (result.outcome == Outcome::compileError) return ExitCode::kNotGradable;
  return result.outcome == Outcome::pass ? ExitCode::kFull : ExitCode::kBelow;
}

// What a whole grading found stays until the next one.
const char* resultName(const TestOptions& options) {
  if (options.debug) return "results-debug.json";
  return options.checks.empty() ? "results.json" : "results-partial.json";
}

// From the result file, which grows while the checks run.
std::string stageOf(const ExerciseInfo& exercise, const std::filesystem::path& results) {
  const std::string name = exercise.name + ": ";
  try {
    const GradeResult soFar = grading::loadResult(results);
    const auto isOpen = [](const grading::CheckResult& check) { return !check.status; };
    const auto open = std::find_if(soFar.checks.begin(), soFar.checks.end(), isOpen);
    if (open == soFar.checks.end()) return name + "looking again";
    return fmt::format("{}check {} of {}, {}", name, open - soFar.checks.begin() + 1, soFar.checks.size(),
                       harmless(open->title));
  } catch (const std::exception&) {
    return name + "compiling";
  }
}

// Others may grade the same exercise at the same time: nobody meets half a result, or parts of two.
void publish(const std::filesystem::path& from, const std::filesystem::path& results) {
  grading::replaceTextFile(results, grading::readTextFile(from), "the result file");
  const std::filesystem::path log = from.parent_path() / "build.log";
  if (std::filesystem::exists(log))
    grading::replaceTextFile(results.parent_path() / "build.log", grading::readTextFile(log), "the log");
}

void remember(const Project& project, const ExerciseInfo& exercise, const grading::Submission& graded) {
  const GradeResult& result = graded.result;
  if (result.outcome == Outcome::graderError) return;
  ProgressFile(project.root).change(exercise.name, [&](Progress& progress) {
    progress.tested = true;
    progress.points = result.score;
    progress.maxPoints = result.maxScore;
    progress.solved = progress.solved || result.outcome == Outcome::pass;
    progress.fileSha256 = result.snapshotSha256;
  });
}

}  // namespace

ExitCode test(const Project& project, const TestOptions& options) {
  const ExerciseInfo exercise = project.exercise(options.exercise);
  if (!options.secret.empty()) static_cast<void>(grading::readCourseSecret(options.secret));
  const std::filesystem::path file = chooseStudentFile(exercise, options.solution, options.main);
  const std::filesystem::path out = std::filesystem::absolute(
      options.out.empty() ? project.outFolder(exercise, options.solution) : options.out);
  std::filesystem::create_directories(out);
  const std::filesystem::path results = out / resultName(options);
  const std::optional<sandbox::Sandbox> sandbox = chooseSandbox(project, options.level);
  if (!sandbox) return ExitCode::kWeakSandbox;
  const grading::Toolchain toolchain = prepare(project, exercise);
  const grading::PrivateFolder work(project.buildFolder(exercise));
  const std::filesystem::path ownResults = work.path() / "results.json", evidence = work.path() / "checks";
  const grading::Submission graded = [&] {
    const ProgressLine line([&] { return stageOf(exercise, ownResults); });
    return grading::gradeSubmission(toolchain, exercise,
                                    {.main = file,
                                     .workFolder = work.path(),
                                     .results = ownResults,
                                     .checks = options.checks,
                                     .seed = options.seed,
                                     .evidence = evidence,
                                     .lookAgain = true,
                                     .sanitize = options.debug,
                                     .sandbox = *sandbox,
                                     .secret = options.secret});
  }();
  publish(ownResults, results);
  std::filesystem::remove_all(out / "checks");
  if (std::filesystem::exists(evidence))
    std::filesystem::copy(evidence, out / "checks", std::filesystem::copy_options::recursive);
  if (options.main.empty() && !options.solution && !options.debug && options.checks.empty())
    remember(project, exercise, graded);
  if (options.json)
    std::fputs(grading::readTextFile(ownResults).c_str(), stdout);
  else
    printResult(exercise, graded, results, options.checks.empty());
  return exitCodeOf(graded.result);
}

}  // namespace rex::cli
