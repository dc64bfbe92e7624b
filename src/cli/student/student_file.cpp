#include "cli/student/student_file.h"

#include <algorithm>
#include <sstream>

#include <fmt/format.h>

#include "base/error.h"
#include "base/text_file.h"
#include "cli/build_on_demand.h"
#include "cli/terminal.h"
#include "submission/program_build.h"

namespace rex::cli {

using grading::CompileDiagnostic;

namespace {

// The compiler counts columns with tab stops every eight.
std::string expandTabs(const std::string& line) {
  std::string expanded;
  for (const char c : line) {
    if (c == '\t')
      expanded.append(8 - expanded.size() % 8, ' ');
    else
      expanded += c;
  }
  return expanded;
}

std::string lineOf(const std::string& source, int number) {
  std::istringstream lines(source);
  std::string line;
  while (number-- > 0)
    if (!std::getline(lines, line)) return "";
  return line;
}

// In a course folder: the student's show.cpp if it is not as it was handed out, for then it is not compiled
// yet.
std::filesystem::path ownShow(const ExerciseInfo& exercise) {
  const std::filesystem::path own = exercise.folder / "show.cpp",
                              handedOut = exercise.definition / "show.cpp";
  if (exercise.folder == exercise.definition || !std::filesystem::exists(own)) return {};
  const bool isSame = std::filesystem::exists(handedOut) && readTextFile(own) == readTextFile(handedOut);
  return isSame ? std::filesystem::path() : own;
}

// Exercises are not linked with the server of a live page, which main() may want.
void addLiveView(const Project& project, const submission::StudentObject& object,
                 submission::Toolchain& toolchain) {
  constexpr const char* kHeader = "course/live_view.h";
  if (object.source.find(kHeader) == std::string::npos) return;
  const auto program = submission::readProgramToolchain(project.build / "student" / "program.json");
  std::vector<std::string> targets;
  for (const submission::LibraryPart& one : librariesFor(program, {program.sourceFolder / kHeader}, "")) {
    targets.push_back(one.target);
    toolchain.libraries.push_back(one.file);
  }
  bringUpToDate(project, targets, "the live page");
}

}  // namespace

std::filesystem::path chooseStudentFile(const ExerciseInfo& exercise, bool solution,
                                        const std::filesystem::path& main) {
  if (!main.empty()) return main;
  const std::filesystem::path file = exercise.folder / (solution ? "solution.cpp" : "main.cpp");
  if (solution && !std::filesystem::exists(file))
    throw UsageError(
        {.what = fmt::format("{} has no solution here", exercise.name), .where = {file.string()}});
  return file;
}

void explain(const std::vector<CompileDiagnostic>& messages, const std::string& source,
             const std::filesystem::path& log) {
  const auto isError = [](const CompileDiagnostic& message) { return message.severity == "error"; };
  const auto first = std::find_if(messages.begin(), messages.end(), isError);
  if (first == messages.end()) return;
  note(wrap(escapeForTerminal(toString(*first)), 2, 0));
  const std::string line = first->line > 0 ? lineOf(source, first->line) : "";
  if (!line.empty()) {
    note("  " + escapeForTerminal(expandTabs(line)));
    if (first->column > 0) note(fmt::format("{:>{}}", '^', 2 + first->column));
  }
  const auto others = std::count_if(messages.begin(), messages.end(), isError) - 1;
  if (others > 0) note(fmt::format("and {} more; the first one often causes the rest.", others));
  note(fmt::format("Full log: {}", shown(log)));
}

std::optional<std::filesystem::path> buildProgram(const Project& project, const ExerciseInfo& exercise,
                                                  const submission::StudentBuildOptions& options,
                                                  const std::filesystem::path& out) {
  submission::Toolchain toolchain = prepare(project, exercise);
  const std::filesystem::path show = ownShow(exercise);
  if (!show.empty()) {
    const submission::StudentObject object =
        compileStudent(toolchain, {}, {.main = show, .workFolder = options.workFolder / "show"});
    if (!object.ok) {
      writeTextFile(out / "build.log", object.log);
      explain(object.messages, object.source, out / "build.log");
      return {};
    }
    toolchain.show = object.object;
  }
  return buildProgram(toolchain, options, out / "build.log", [&](const submission::StudentObject& object) {
    addLiveView(project, object, toolchain);
  });
}

namespace {

using Link = std::function<submission::StudentProgram(const submission::StudentObject& object)>;

std::optional<std::filesystem::path> compileAndLink(const submission::Toolchain& toolchain,
                                                    const submission::StudentBuildOptions& options,
                                                    const std::filesystem::path& log, const Link& link) {
  // Students may try anything here: only grading looks for forbidden calls.
  const submission::StudentObject object = compileStudent(toolchain, {}, options);
  writeTextFile(log, object.log);
  if (!object.ok) {
    explain(object.messages, object.source, log);
    return {};
  }
  for (const CompileDiagnostic& message : object.messages)
    note(wrap(escapeForTerminal(toString(message)), 2, 0));
  const submission::StudentProgram program = link(object);
  if (program.ok) return program.program;
  writeTextFile(log, program.log);
  explain(program.messages, object.source, log);
  return {};
}

}  // namespace

std::optional<std::filesystem::path> buildProgram(
    const submission::Toolchain& toolchain, const submission::StudentBuildOptions& options,
    const std::filesystem::path& log,
    const std::function<void(const submission::StudentObject& object)>& beforeLinking) {
  return compileAndLink(toolchain, options, log, [&](const submission::StudentObject& object) {
    beforeLinking(object);
    return linkProgram(toolchain, object);
  });
}

std::optional<std::filesystem::path> buildWorker(const Project& project, const ExerciseInfo& exercise,
                                                 const submission::StudentBuildOptions& options,
                                                 const std::filesystem::path& out) {
  const submission::Toolchain toolchain = prepare(project, exercise);
  return compileAndLink(toolchain, options, out / "build.log", [&](const submission::StudentObject& object) {
    return linkWorker(toolchain, object);
  });
}

}  // namespace rex::cli
