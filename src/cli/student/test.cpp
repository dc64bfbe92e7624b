#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "base/exit_code.h"
#include "cli/command_table.h"
#include "cli/option_table_internal.h"
#include "cli/student/test_run.h"

namespace rex::cli {
namespace {

struct TestCommand {
  std::vector<std::string> exercises;
  bool all = false;  ///< all exercises; with one exercise: all messages
  int jobs = 0;      ///< parallel gradings; 0: one per processor
  TestOptions each;
};

// The exercises, each once, in the given order.
std::vector<ExerciseInfo> exercisesOf(const Project& project, const TestCommand& words) {
  if (words.exercises.empty()) return project.exercises();
  std::vector<ExerciseInfo> chosen;
  for (const std::string& name : words.exercises) {
    ExerciseInfo exercise = project.exercise(name);
    const auto isThis = [&](const ExerciseInfo& other) { return other.name == exercise.name; };
    if (std::none_of(chosen.begin(), chosen.end(), isThis)) chosen.push_back(std::move(exercise));
  }
  return chosen;
}

ExitCode test(const Project& project, const TestCommand& words) {
  if (words.exercises.size() != 1)
    return testMany(project, exercisesOf(project, words), words.each, words.jobs);
  TestOptions one = words.each;
  one.exercise = words.exercises.front();
  one.inFull = words.all;
  return testOne(project, one);
}

void addSeveral(CLI::App* command, TestCommand& words) {
  command->add_option("EXERCISE", words.exercises, kExercisesHelp)->type_name("");
  command->add_flag("--all", words.all, "all exercises; after one EXERCISE: all messages");
  addOptions(command, {{"-j,--jobs",
                        words.jobs,
                        {0, 1024},
                        "N",
                        "parallel gradings of several exercises, 0: one per processor"}});
}

}  // namespace

void addTest(CLI::App* command, Action& action) {
  const auto words = std::make_shared<TestCommand>();
  TestOptions* options = &words->each;
  command->footer(
      "Examples:\n  scripts/rex test 01\n  scripts/rex test 01 --check step-hand --seed 17\n"
      "  scripts/rex test 01 --main /tmp/other.cpp --json\n  scripts/rex test 01 02 -j2\n"
      "  scripts/rex test --all\n\n"
      "After the first time it shows the first message and what has changed; EXERCISE --all\n"
      "shows all messages.\n"
      "The result file is results.json, results-partial.json with --check, or\n"
      "results-debug.json with --debug; share/doc/platforms.md lists the reports.\n"
      "For several exercises -o DIR means DIR/EXERCISE,\n"
      "--json is {\"schema\": \"rex-results/1\", \"results\": [...]}, and the exit code is\n"
      "the largest of theirs.\n" +
      std::string(kExitCodesHelp));
  addSeveral(command, *words);
  addOptions(command, {{"--solution", options->solution, "grade the reference solution"},
                       {"--main", options->main, "FILE", "grade this file instead of main.cpp"},
                       {"--check", options->job.checks, "NAME",
                        "only this check, part or failed function; may be given several times"},
                       seedRow(options->job.seed, "repeat the random cases of this seed"),
                       {"--json", options->json, "print the result file and nothing else"},
                       {"--report", options->reports, "FORMATS",
                        "write reports beside it: junit, markdown, ..., or several with commas"},
                       {"--debug", options->debug, "use sanitizers: slow, but names the lines of crashes"},
                       {"-o,--out", options->out, "DIR", kOutHelp}});
  addLevel(command, options->level);
  addOptions(command, {{"--secret-file", options->job.secret, "FILE",
                        "secret of the course, for the seeds of hidden checks"}});
  command->callback([&action, words] {
    const TestOptions& each = words->each;
    if (words->exercises.empty() ? !words->all : words->all && words->exercises.size() > 1)
      throw CLI::RequiredError("either EXERCISE or --all");
    if (each.solution && !each.main.empty()) throw CLI::ExcludesError("--main", "--solution");
    // The sanitizers read and map memory in ways that a sandbox forbids.
    if (each.debug && isConfined(each.level.value_or(sandbox::Level::kLimitsOnly)))
      throw CLI::ExcludesError("--debug", "--level");
    action = [words](const Project& p) { return test(p, *words); };
  });
}

}  // namespace rex::cli
