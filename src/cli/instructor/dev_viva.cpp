#include <fmt/format.h>

#include "authoring/viva.h"
#include "base/error.h"
#include "base/folders.h"
#include "cli/instructor/dev_verbs.h"
#include "cli/sandbox_choice.h"
#include "cli/terminal.h"

namespace rex::cli {

ExitCode devViva(const Project& project, const VivaOptions& options) {
  constexpr std::size_t kQuestions = 3;
  const ExerciseInfo exercise = project.exercise(options.exercise);
  if (!std::filesystem::is_regular_file(options.file))
    throw UsageError({.what = "FILE",
                      .where = {options.file.string()},
                      .found = std::filesystem::exists(options.file) ? "a folder" : "no such file",
                      .wanted = "the main.cpp that was handed in"});
  const auto sandbox = chooseSandbox(project, options.level);
  if (!sandbox) return ExitCode::kWeakSandbox;
  const PrivateFolder work(project.workPlace("exercises/" + exercise.name));
  const std::vector<authoring::VivaQuestion> questions = authoring::vivaQuestions(
      prepare(project, exercise), exercise, options.file, *sandbox, work.path(), kQuestions);
  const auto paragraph = [](const std::string& start, const std::string& text) {
    say(start + wrap(escapeForTerminal(text), 3, start.size()));
  };
  for (std::size_t k = 0; k < questions.size(); ++k) {
    const authoring::VivaQuestion& one = questions[k];
    say(fmt::format("{}. Line {}, in {}:", k + 1, one.line, escapeForTerminal(one.function)));
    say("     " + escapeForTerminal(one.before));
    say("   If it were");
    say("     " + escapeForTerminal(one.after));
    say("   which check would fail first, and why?");
    paragraph("   Answer: ", fmt::format("{} [{}]. {}", one.title, one.check, one.message));
    say();
  }
  if (questions.size() < kQuestions)
    note(fmt::format("{} of {} questions: no other change that was tried fails a check by its answers.",
                     questions.size(), kQuestions));
  return questions.size() < kQuestions ? ExitCode::kBelow : ExitCode::kFull;
}

}  // namespace rex::cli
