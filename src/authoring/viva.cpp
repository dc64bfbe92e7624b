#include "authoring/viva.h"

#include <algorithm>
#include <set>
#include <utility>

#include "authoring/killed_mutants.h"
#include "authoring/mutants.h"
#include "base/error.h"
#include "base/text_file.h"
#include "submission/student_build.h"
#include "submission/submission.h"

namespace rex::authoring {
namespace {

using grading::CheckResult;
using grading::Outcome;

// One change of each function in turn, so that the questions are about all of the file.
std::vector<Mutant> inTurns(const std::vector<Mutant>& mutants) {
  std::vector<Mutant> turns, rest = mutants;
  while (!rest.empty()) {
    std::set<std::string> asked;
    std::vector<Mutant> later;
    for (Mutant& mutant : rest) {
      const bool isFirst = asked.insert(mutant.function).second;
      (isFirst ? turns : later).push_back(std::move(mutant));
    }
    rest = std::move(later);
  }
  return turns;
}

/// Grades versions of one file in the visible checks.
class VersionGrader {
 public:
  VersionGrader(const submission::Toolchain& toolchain, const submission::ExerciseInfo& exercise,
                const sandbox::Sandbox& sandbox, const std::filesystem::path& workFolder)
      : toolchain_(toolchain),
        exercise_(exercise),
        options_{.main = workFolder / "main.cpp",
                 .workFolder = workFolder / "build",
                 .job = {.results = workFolder / "results.json", .sandbox = sandbox}} {
    for (const CheckResult& check : submission::listChecks(toolchain))
      if (check.group == grading::Group::kVisible) options_.job.checks.push_back(check.id);
  }

  std::vector<CheckResult> grade(const std::string& text) {
    writeTextFile(options_.main, text);
    const grading::GradeResult result = submission::gradeSubmission(toolchain_, exercise_, options_).result;
    if (result.outcome == Outcome::kGraderError)
      throw Error({.what = "cannot grade a version of the file", .found = result.message});
    return result.checks;
  }
  // From now on.
  void gradeOnly(std::vector<std::string> checks) { options_.job.checks = std::move(checks); }

 private:
  const submission::Toolchain& toolchain_;
  const submission::ExerciseInfo& exercise_;
  submission::SubmissionOptions options_;
};

}  // namespace

std::vector<VivaQuestion> vivaQuestions(const submission::Toolchain& toolchain,
                                        const submission::ExerciseInfo& exercise,
                                        const std::filesystem::path& file, const sandbox::Sandbox& sandbox,
                                        const std::filesystem::path& workFolder, std::size_t most) {
  const std::string text = submission::readStudentFile(file);
  VersionGrader grader(toolchain, exercise, sandbox, workFolder);
  std::vector<std::string> passed;
  for (const CheckResult& check : grader.grade(text))
    if (check.status == Outcome::kPass) passed.push_back(check.id);
  if (passed.empty())
    throw Error({.what = "nothing to ask about",
                 .where = {file.string()},
                 .found = "a file that passes no visible check",
                 .wanted = "one"});
  grader.gradeOnly(passed);

  std::vector<VivaQuestion> questions;
  const std::vector<Mutant> all = mutantsOfFile(text);
  int tries = 0;
  for (const Mutant& mutant : inTurns(drawnMutants(all, all.size()))) {
    const auto isAsked = [&](const VivaQuestion& one) { return one.line == mutant.line; };
    if (std::any_of(questions.begin(), questions.end(), isAsked)) continue;
    if (questions.size() == most || tries++ == kMostTries) break;
    const std::vector<CheckResult> checks = grader.grade(mutated(text, mutant));
    const auto failed = std::find_if(checks.begin(), checks.end(),
                                     [](const CheckResult& check) { return check.status == Outcome::kFail; });
    if (failed == checks.end()) continue;
    questions.push_back({.function = mutant.function,
                         .line = mutant.line,
                         .before = mutant.before,
                         .after = mutant.after,
                         .check = failed->id,
                         .title = failed->title,
                         .message = failed->message});
  }
  std::sort(questions.begin(), questions.end(), [](const auto& a, const auto& b) { return a.line < b.line; });
  return questions;
}

}  // namespace rex::authoring
