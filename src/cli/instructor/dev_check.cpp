#include <fmt/format.h>

#include "authoring/gates.h"
#include "base/error.h"
#include "base/private_folder.h"
#include "cli/build_on_demand.h"
#include "cli/instructor/dev_verbs.h"
#include "cli/terminal.h"

namespace rex::cli {
namespace {

std::vector<ExerciseInfo> chosen(const Project& project, const std::string& name) {
  if (name.empty()) return project.exercises();
  return {project.exercise(name)};
}

// Prints one line for a gate, and what is wrong unless it passed.
bool passes(const Project& project, const ExerciseInfo& exercise, const grading::Toolchain& toolchain,
            const std::string& gate, const CheckOptions& options) {
  const PrivateFolder work(project.workPlace("exercises/" + exercise.name));
  const grading::GateResult result = grading::runGate({.root = project.root,
                                                       .exercise = exercise,
                                                       .toolchain = toolchain,
                                                       .workFolder = work.path(),
                                                       .seeds = options.seeds,
                                                       .sheet = options.sheet},
                                                      gate);
  say(fmt::format(" {}  {}  {}", result.passed ? paint(Colour::kGreen, " ok ") : paint(Colour::kRed, "FAIL"),
                  exercise.name, gate));
  if (!result.passed) say("       " + wrap(harmless(result.message), 7, 7));
  if (!result.note.empty()) say("       " + wrap(harmless(result.note), 7, 7));
  return result.passed;
}

// The number of gates that did not pass.
int checkOne(const Project& project, const ExerciseInfo& exercise, const CheckOptions& options) {
  const grading::Toolchain toolchain = prepare(project, exercise);
  const std::vector<std::string> gates =
      options.gate.empty() ? grading::gateNames(exercise) : std::vector<std::string>{options.gate};
  int open = 0;
  for (const std::string& gate : gates) open += passes(project, exercise, toolchain, gate, options) ? 0 : 1;
  return open;
}

}  // namespace

ExitCode devCheck(const Project& project, const CheckOptions& options) {
  const std::vector<ExerciseInfo> exercises = chosen(project, options.exercise);
  if (exercises.empty()) note("There are no exercises to check.");
  int open = 0, blocked = 0;
  for (const ExerciseInfo& exercise : exercises) {
    if (options.listGates) {
      for (const std::string& gate : grading::gateNames(exercise)) say(gate);
      continue;
    }
    try {
      open += checkOne(project, exercise, options);
    } catch (const BuildFailure& failure) {
      note(fmt::format("rex: {}", failure.what()));
      ++blocked;
    }
  }
  if (open > 0) note(fmt::format("{} gate{} not passed.", open, open == 1 ? "" : "s"));
  if (blocked > 0) note(fmt::format("{} exercise{} not checked.", blocked, blocked == 1 ? "" : "s"));
  if (blocked > 0) return ExitCode::kGraderFault;
  return open == 0 ? ExitCode::kFull : ExitCode::kBelow;
}

}  // namespace rex::cli
