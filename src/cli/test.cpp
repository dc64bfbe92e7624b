#include <algorithm>

#include <fmt/format.h>

#include "base/error.h"
#include "cli/commands.h"
#include "cli/sandbox_choice.h"
#include "cli/student_file.h"
#include "cli/terminal.h"
#include "grading/compiler_messages.h"
#include "grading/private_folder.h"
#include "grading/submission.h"
#include "grading/text_file.h"

namespace rex::cli {
namespace {

using grading::CheckResult;
using grading::GradeResult;
using grading::Outcome;

ExitCode exitCodeOf(const GradeResult& result) {
  if (result.outcome == Outcome::graderError) return ExitCode::kGraderFault;
  if (result.outcome == Outcome::compileError) return ExitCode::kNotGradable;
  return result.outcome == Outcome::pass ? ExitCode::kFull : ExitCode::kBelow;
}

std::string verdict(const CheckResult& check) {
  if (!check.status) return paint(Colour::kYellow, " -  ");
  if (*check.status == Outcome::pass) return paint(Colour::kGreen, " ok ");
  return check.points > 0 ? paint(Colour::kYellow, "part") : paint(Colour::kRed, "FAIL");
}

void printChecks(const ExerciseInfo& exercise, const std::vector<CheckResult>& checks) {
  constexpr std::size_t kIndent = 13;  // where titles begin, below each other
  for (const grading::ExercisePart& part : exercise.parts) {
    const auto isOfPart = [&](const CheckResult& check) { return check.part == part.id; };
    if (std::none_of(checks.begin(), checks.end(), isOfPart)) continue;
    say(paint(Colour::kBold, part.title));
    for (const CheckResult& check : checks) {
      if (!isOfPart(check)) continue;
      const std::string hidden = check.group == grading::Group::hidden ? ", hidden" : "";
      const std::string title = fmt::format("{} [{}{}]", harmless(check.title), check.id, hidden);
      say(fmt::format(" {} {:2}/{:<2}  {}", verdict(check), check.points, check.maxPoints,
                      wrap(title, kIndent, kIndent)));
      if (check.status != Outcome::pass && !check.message.empty())
        say(std::string(kIndent, ' ') + wrap(harmless(check.message), kIndent, kIndent));
    }
  }
}

void printResult(const ExerciseInfo& exercise, const grading::Submission& graded,
                 const std::filesystem::path& results) {
  const GradeResult& result = graded.result;
  say(paint(Colour::kBold, fmt::format("{}: {}", exercise.name, exercise.title)));
  if (result.outcome == Outcome::compileError) {
    std::fflush(stdout);
    explain(result.compile.diagnostics, graded.source, results.parent_path() / "build.log");
    say("Not graded: no check could run.");
  } else {
    printChecks(exercise, result.checks);
    for (const auto& message : result.compile.diagnostics) say(wrap(harmless(toString(message)), 2, 0));
    if (result.outcome == Outcome::graderError)
      say(wrap("The grader itself failed: not your fault, and not your grade. " + harmless(result.message), 0,
               0));
    const bool full = result.outcome == Outcome::pass;
    say(paint(full ? Colour::kGreen : Colour::kBold,
              fmt::format("{} of {} points", result.score, result.maxScore)));
  }
  say("Result: " + shown(results));
}

}  // namespace

ExitCode test(const Project& project, const TestOptions& options) {
  const ExerciseInfo exercise = project.exercise(options.exercise);
  const std::filesystem::path file = chooseStudentFile(exercise, options.solution, options.main);
  const std::filesystem::path out = std::filesystem::absolute(
      options.out.empty() ? project.outFolder(exercise, options.solution) : options.out);
  std::filesystem::create_directories(out);
  // What a whole grading found stays until the next one.
  const std::filesystem::path results =
      out / (options.checks.empty() ? "results.json" : "results-partial.json");
  const std::optional<sandbox::Sandbox> sandbox = chooseSandbox(project, options.level);
  if (!sandbox) return ExitCode::kWeakSandbox;
  const grading::Toolchain toolchain = prepare(project, exercise);
  const grading::PrivateFolder work(project.buildFolder(exercise));
  const grading::Submission graded = grading::gradeSubmission(toolchain, exercise,
                                                              {.main = file,
                                                               .workFolder = work.path(),
                                                               .results = results,
                                                               .checks = options.checks,
                                                               .seed = options.seed,
                                                               .sandbox = *sandbox});
  if (options.json) {
    std::fputs(grading::readTextFile(results).c_str(), stdout);
  } else {
    printResult(exercise, graded, results);
  }
  return exitCodeOf(graded.result);
}

}  // namespace rex::cli
