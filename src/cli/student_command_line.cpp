// The commands of the student's loop besides run and test.
#include <memory>
#include <string>

#include <CLI/CLI.hpp>

#include "cli/command_line_internal.h"
#include "cli/commands.h"

namespace rex::cli {
namespace {

void addWatch(CLI::App& program, Action& action) {
  const auto options = std::make_shared<WatchOptions>();
  CLI::App* command =
      add(program, "watch", "Grade your main.cpp now and whenever you save it",
          "Example: scripts/rex watch 01\n\n"
          "Notices saves by inotify, or by looking five times a second where that fails, and says\n"
          "which. In a terminal single keys give hints and more; elsewhere it ends at the full score.");
  addExercise(command, options->exercise);
  command->add_flag("--poll", options->poll, "look at the file, do not ask inotify");
  command->callback(
      [&action, options] { action = [options](const Project& p) { return watch(p, *options); }; });
}

void addHint(CLI::App& program, Action& action) {
  const auto options = std::make_shared<HintOptions>();
  CLI::App* command = add(program, "hint", "Show the next hint for an exercise",
                          "Examples:\n  scripts/rex hint 01\n  scripts/rex hint 01 step --again\n\n"
                          "Without PART, for the first part that lost points in your last test.");
  addExercise(command, options->exercise);
  command->add_option("PART", options->part, "id of a part in exercise.toml")->type_name("");
  command->add_flag("--again", options->again, "show those that you have seen");
  command->callback(
      [&action, options] { action = [options](const Project& p) { return hint(p, *options); }; });
}

void addShow(CLI::App& program, Action& action) {
  const auto options = std::make_shared<ShowOptions>();
  CLI::App* command = add(program, "show", "Say where the replay, films and pictures of an exercise are",
                          "Example: scripts/rex show 01");
  addExercise(command, options->exercise);
  command->add_flag("--solution", options->solution, "those of the reference solution");
  command->callback(
      [&action, options] { action = [options](const Project& p) { return show(p, *options); }; });
}

void addReset(CLI::App& program, Action& action) {
  const auto name = std::make_shared<std::string>();
  CLI::App* command =
      add(program, "reset", "Start again with main.cpp as it was handed out",
          "Example: scripts/rex reset 01\n\nYour file is kept beside it as main.backup-1.cpp.");
  addExercise(command, *name);
  command->callback([&action, name] { action = [name](const Project& p) { return reset(p, *name); }; });
}

void addSolution(CLI::App& program, Action& action) {
  const auto name = std::make_shared<std::string>();
  CLI::App* command = add(program, "solution", "Print the reference solution, where the course allows it",
                          "Example: scripts/rex solution 01");
  addExercise(command, *name);
  command->callback([&action, name] { action = [name](const Project& p) { return solution(p, *name); }; });
}

void addSubmit(CLI::App& program, Action& action) {
  const auto options = std::make_shared<SubmitOptions>();
  CLI::App* command = add(program, "submit", "Write the zip file to hand in, with a receipt",
                          "Examples:\n  scripts/rex submit 01\n  scripts/rex submit 01 02 -o handin.zip\n\n"
                          "It holds EXERCISE/main.cpp of each, nothing else of yours, and receipt.json with\n"
                          "the SHA-256 hash of every file.");
  command
      ->add_option("EXERCISE", options->exercises,
                   "numbers, topics or whole names: 01, kinematics, 01-kinematics")
      ->type_name("")
      ->required();
  command->add_option("-o,--out", options->out, "file to write (default: handin.zip)")->type_name("FILE.zip");
  command->callback(
      [&action, options] { action = [options](const Project& p) { return submit(p, *options); }; });
}

}  // namespace

void addExercise(CLI::App* command, std::string& exercise) {
  command->add_option("EXERCISE", exercise, "number, topic or whole name: 01, kinematics, 01-kinematics")
      ->type_name("")
      ->required();
}

void addStudentCommands(CLI::App& program, Action& action) {
  addWatch(program, action), addHint(program, action), addShow(program, action);
  addReset(program, action), addSolution(program, action), addSubmit(program, action);
}

}  // namespace rex::cli
