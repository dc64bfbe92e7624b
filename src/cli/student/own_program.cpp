#include "cli/student/own_program.h"

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <iterator>

#include <fmt/format.h>
#include <string.h>
#include <unistd.h>

#include "base/error.h"
#include "base/folders.h"
#include "base/process.h"
#include "base/text.h"
#include "base/text_file.h"
#include "cli/build_on_demand.h"
#include "cli/out_folder.h"
#include "cli/student/course_folder.h"
#include "cli/student/student_file.h"
#include "cli/terminal.h"
#include "grading/limits.h"
#include "submission/included_files.h"
#include "submission/made_from.h"
#include "submission/program_build.h"
#include "submission/sanitizer_rerun.h"

namespace rex::cli {

namespace {

namespace fs = std::filesystem;

bool isExercise(const Project& project, const std::string& name) {
  return std::ranges::any_of(project.exercises(), [&](const ExerciseInfo& one) { return one.name == name; });
}

// Whether it is an exercise's main.cpp, which students edit.
bool isMainOfExercise(const Project& project, const fs::path& file) {
  std::error_code ignored;
  return file.filename() == "main.cpp" &&
         fs::equivalent(file.parent_path().parent_path(), project.root / "exercises", ignored) &&
         isExercise(project, file.parent_path().filename().string());
}

[[noreturn]] void failWithoutFile(const fs::path& file) {
  std::vector<std::string> names;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(fs::absolute(file).parent_path(), ignored))
    if (entry.path().extension() == ".cpp") names.push_back(entry.path().filename().string());
  throw UsageError({.what = fmt::format("there is no program '{}'", file.string()),
                    .found = fs::exists(file, ignored) ? "a folder or device" : "no such file",
                    .wanted = "an exercise, or the path of a .cpp file",
                    .nearest = nearestNames(file.filename().string(), names)});
}

}  // namespace

std::variant<fs::path, ExerciseInfo> programMeant(const Project& project, const std::string& argument) {
  const fs::path file = argument;
  std::error_code ignored;
  if (file.extension() != ".cpp") return project.exercise(argument);
  const bool isExample = !fs::exists(file, ignored) && fs::is_regular_file(project.files() / file, ignored);
  if (isExample || fs::is_regular_file(file, ignored)) {
    const fs::path whole = fs::canonical(isExample ? project.files() / file : file);
    if (!isMainOfExercise(project, whole)) return whole;
    return project.exercise(whole.parent_path().filename().string());
  }
  // A name completed by the shell in the folder of all exercises: 01-kinematics/main.cpp.
  const std::string name = file.parent_path().filename().string();
  if (file.filename() == "main.cpp" && isExercise(project, name)) return project.exercise(argument);
  failWithoutFile(file);
}

fs::path programOutFolder(const Project& project, const fs::path& file) {
  const std::string name =
      file.filename() == "main.cpp" ? file.parent_path().filename().string() : file.stem().string();
  if (isExercise(project, name))
    throw UsageError({.what = fmt::format("the results of '{}' would mix with those of the exercise {}",
                                          shown(file), name),
                      .wanted = "another folder for them: -o DIR"});
  return project.root / "out" / name;
}

std::optional<OwnProgram> buildOwnProgram(const Project& project, const fs::path& file,
                                          const fs::path& workFolder, const fs::path& log) {
  submission::ProgramToolchain program =
      submission::readProgramToolchain(project.build / "student" / "program.json");
  submission::Toolchain& toolchain = program.toolchain;
  if (!project.installed.empty()) toolchain.prefix = prefixFile(project);
  const std::string source = readTextFile(file);
  if (!toolchain.prefix.empty() && submission::opensWithCourseHeader(source, toolchain.flags)) {
    bringUpToDate(project, {"rex_student_prefix"}, "what programs start from");
    // Without the compiled file, an attempt has failed: `rex update` tries again.
    const bool isNew = !fs::exists(toolchain.prefix), isMade = fs::exists(toolchain.prefix.string() + ".gch");
    if (!project.installed.empty() && (isNew || isMade)) prepareCompiler(project);
  }
  const bool hasPrefix = !submission::prefixFlags(toolchain.prefix, source, toolchain.flags).empty();
  toolchain.flags.insert(toolchain.flags.end(), {"-I", file.parent_path().string()});
  OwnProgram result{.madeFrom = {file, project.build / "student" / "program.json"}};
  const auto chooseLibraries = [&](const submission::StudentObject& object) {
    const ProcessResult table =
        runProcess({toolchain.objdump, "-t", "-C", object.object.string()}, {.outputLimit = 256u << 20});
    if (!table.ok())
      throw Error({.what = "cannot list what the compiled file refers to", .found = table.error});
    auto files = submission::dependenciesIn(readTextFile(workFolder / "student.d"), workFolder);
    // The compiler does not list the files of its precompiled prefix.
    if (hasPrefix)
      std::ranges::copy(
          submission::dependenciesIn(readTextFile(toolchain.prefix.string() + ".d"), workFolder),
          std::back_inserter(files));
    for (fs::path& one : files) one = one.lexically_normal();
    std::ranges::copy_if(files, std::back_inserter(result.madeFrom),
                         [&](const fs::path& one) { return !isBelow(workFolder, one); });
    for (const submission::LibraryPart& one : librariesFor(program, files, table.output)) {
      result.targets.push_back(one.target);
      toolchain.libraries.push_back(one.file);
    }
    if (!result.targets.empty())
      bringUpToDate(project, result.targets, "the library for " + file.filename().string());
  };
  const auto linked = buildProgram(toolchain, {.main = file, .workFolder = workFolder}, log, chooseLibraries);
  if (!linked) return {};
  result.program = *linked;
  result.toolchain = toolchain;
  return result;
}

namespace {

// Lists what was written since then: older files show what an earlier program did.
void listResults(const fs::path& folder, fs::file_time_type since) {
  std::vector<fs::path> written = filesIn(folder);
  std::erase_if(written, [&](const fs::path& file) { return fs::last_write_time(file) < since; });
  const std::vector<std::string> files = shortList(written);
  if (!files.empty()) say("\nFiles in " + shown(folder) + ":");
  for (const std::string& line : files) say("  " + line);
}

// The record, the targets of its libraries, an empty line, and stamps, is written last, and whole. There is
// none if a file changed while it was compiled.
void keep(const OwnProgram& built, const fs::path& kept, fs::file_time_type started) {
  fs::create_directories(kept.parent_path());
  const fs::path record = submission::recordFile(kept);
  fs::remove(record);
  const fs::path half = fmt::format("{}.{}", kept.string(), ::getpid());
  fs::copy_file(built.program, half, fs::copy_options::overwrite_existing);
  fs::rename(half, kept);
  const std::string stamps = submission::timeStamps(built.madeFrom, started);
  if (stamps.empty()) return;
  replaceTextFile(record, join(built.targets, "\n") + "\n\n" + stamps, "what a program was made from");
}

// Whether a compiler would make the kept program again. The libraries are shared: they are brought up to date
// like those of a new one.
bool isCurrent(const Project& project, const fs::path& kept, const std::string& name) {
  if (!fs::exists(kept) || !fs::exists(submission::recordFile(kept))) return false;
  const std::string record = readTextFile(submission::recordFile(kept));
  const std::size_t gap = record.find("\n\n");
  if (gap == record.npos || !submission::haveStamps(std::string_view(record).substr(gap + 2))) return false;
  std::vector<std::string> targets;
  for (const std::string_view one : splitLines(std::string_view(record).substr(0, gap)))
    if (!one.empty()) targets.emplace_back(one);
  if (!targets.empty()) bringUpToDate(project, targets, "the library for " + name);
  return true;
}

}  // namespace

Ended runIn(const std::vector<std::string>& command, const OwnRun& options) {
  std::fflush(stdout);
  constexpr double kNoTimeout = 1e6;
  // The times of files come from a coarser clock.
  const auto start = fs::file_time_type::clock::now() - std::chrono::milliseconds(20);
  const ProcessResult result = runProcess(command, {.directory = options.out,
                                                    .environment = options.environment,
                                                    .timeout = kNoTimeout,
                                                    .inheritOutput = true,
                                                    .cpuSeconds = static_cast<double>(options.seconds)});
  if (options.listsFiles) listResults(options.out, start);
  if (result.ok()) return Ended::kWell;
  if (result.signal == 0) {
    note(fmt::format("\nThe program ended with exit code {}.", result.exitCode));
    return Ended::kBadly;
  }
  if (result.signal == SIGXCPU || (result.signal == SIGKILL && result.cpuSeconds >= options.seconds)) {
    note(fmt::format("\nThe program was stopped after {} s of CPU time; --time-limit S allows more.",
                     options.seconds));
    return Ended::kTooLate;
  }
  note(fmt::format("\nThe program was ended by signal {} ({}).", result.signal, ::strsignal(result.signal)));
  return result.signal == SIGINT ? Ended::kBadly : Ended::kCrashed;
}

void sayWhereItEnded(const submission::Toolchain& toolchain, const submission::StudentBuildOptions& build,
                     const OwnRun& options, Ended ended) {
  if (ended != Ended::kCrashed && ended != Ended::kTooLate) return;
  const bool isLate = ended == Ended::kTooLate;
  const double seconds = isLate ? std::min(2, options.seconds) : options.seconds;
  fs::create_directories(build.workFolder);
  const submission::Toolchain locating =
      submission::locatingToolchain(toolchain, build.workFolder, 4096 * grading::kMegabyte, seconds);
  const auto object = compileStudent(locating, {}, build);
  if (!object.ok) return;
  const auto program = linkProgram(locating, object);
  if (!program.ok) return;
  std::vector<std::string> command = {program.program.string()};
  command.insert(command.end(), options.arguments.begin(), options.arguments.end());
  const ProcessResult run = runProcess(command, {.directory = build.workFolder});
  const auto site = submission::crashSiteIn(run.error, object.name);
  if (!site || site->line == 0) return;
  const std::string place =
      fmt::format("in line {} of {}, in {}", site->line, object.name, escapeForTerminal(site->function));
  note(isLate ? fmt::format("After {:.0f} s it is {}: an endless loop?", seconds, place)
              : fmt::format("It was {}.", place));
}

ExitCode toExitCode(Ended ended) { return ended == Ended::kWell ? ExitCode::kFull : ExitCode::kBelow; }

ExitCode runOwnProgram(const Project& project, const fs::path& file, const OwnRun& options) {
  makeOutFolder(options.out);
  const PrivateFolder work(project.workPlace("student"));
  fs::path program = options.keptAs;
  std::optional<OwnProgram> built;
  if (program.empty() || !isCurrent(project, program, file.filename().string())) {
    const auto started = fs::file_time_type::clock::now();
    built = buildOwnProgram(project, file, work.path(),
                            options.log.empty() ? options.out / "build.log" : options.log);
    if (!built) return ExitCode::kNotGradable;
    if (program.empty())
      program = built->program;
    else
      keep(*built, program, started);
  }
  std::vector<std::string> command = {program.string()};
  command.insert(command.end(), options.arguments.begin(), options.arguments.end());
  const Ended ended = runIn(command, options);
  if (built && options.keptAs.empty())
    sayWhereItEnded(built->toolchain, {.main = file, .workFolder = work.path() / "again"}, options, ended);
  return toExitCode(ended);
}

}  // namespace rex::cli
