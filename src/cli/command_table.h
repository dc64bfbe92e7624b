#pragma once

#include <functional>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/exit_code.h"
#include "cli/project.h"

namespace CLI {
class App;  // of CLI11
}

namespace rex::cli {

/// The programs behind `rex`: itself, with the commands for exercises; the one for robots and methods, which
/// the first exercise does not wait for; and `rex-teach` for courses and authors.
enum class Program { kStudent, kRobot, kInstructor };

/// Its name, which is that of its file in the build folder and of its build target.
[[nodiscard]] std::string programName(Program program);

/// The groups of `rex --help`.
enum class Topic { kExercises, kRobots, kMethods, kCourses };

[[nodiscard]] const char* toString(Topic topic);

/// What every program knows about a command, including those that it hands over.
struct TableEntry {
  std::string_view name{};
  std::string_view purpose{};  ///< one line of `rex --help`
  Topic topic{};
  Program program{};  ///< the program that runs it
};

/// All commands of `rex`, in the order of its help.
[[nodiscard]] std::span<const TableEntry> commandTable();

/// A command of earlier versions, and the line that a user now types.
struct OldCommand {
  std::string_view name{}, now{};
};

/// They answer in this version; the next one may forget them.
[[nodiscard]] std::span<const OldCommand> oldCommands();

/// What the command line requests, ready to be run.
using Action = std::function<ExitCode(const Project&)>;

/// Adds options and examples to a command; `action` is set if the user calls it. Both outlive the parsing.
using Registration = void (*)(CLI::App* command, Action& action);

/// What one program does itself: the commands that the table assigns to it.
struct CommandSet {
  Program program{};
  std::map<std::string_view, Registration> commands{};
  Action withoutCommand{};             ///< empty: `rex` handles it
  Project (*project)() = findProject;  ///< what its commands work with
  /// For completion: what the file of a scene calls its postures, given the words of the command.
  std::vector<std::string> (*postures)(const Project&, std::span<const std::string> words) = nullptr;
};

/// The commands of the programs; each set is defined in the library of its folder.
[[nodiscard]] CommandSet studentCommands();
[[nodiscard]] CommandSet robotCommands();
[[nodiscard]] CommandSet instructorCommands();

/// The commands, in a file each; see Registration.
void addDebug(CLI::App* command, Action& action);
void addDemo(CLI::App* command, Action& action);
void addDev(CLI::App* command, Action& action);
void addDoctor(CLI::App* command, Action& action);
void addExport(CLI::App* command, Action& action);
void addGrade(CLI::App* command, Action& action);
void addHint(CLI::App* command, Action& action);
void addImport(CLI::App* command, Action& action);
void addInit(CLI::App* command, Action& action);
void addLinear(CLI::App* command, Action& action);
void addList(CLI::App* command, Action& action);
void addPlan(CLI::App* command, Action& action);
void addRender(CLI::App* command, Action& action);
void addReset(CLI::App* command, Action& action);
void addRun(CLI::App* command, Action& action);
void addScene(CLI::App* command, Action& action);
void addShow(CLI::App* command, Action& action);
void addSimulate(CLI::App* command, Action& action);
void addSlam(CLI::App* command, Action& action);
void addSubmit(CLI::App* command, Action& action);
void addTest(CLI::App* command, Action& action);
void addUpdate(CLI::App* command, Action& action);
void addView(CLI::App* command, Action& action);
void addWatch(CLI::App* command, Action& action);

}  // namespace rex::cli
