#include "submission/build_tools.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>

#include "base/error.h"
#include "base/exit_code.h"
#include "base/once_more.h"
#include "base/own_folder.h"
#include "base/text_file.h"
#include "sandbox/report.h"
#include "submission/tool_failure.h"
#include "submission/worker_part.h"

namespace rex::grading {
namespace {

namespace fs = std::filesystem;

// __DATE__ and __TIME__ are always the start of 1970 (reproducible-builds.org); __TIMESTAMP__: writeSource().
constexpr const char *kDate = "SOURCE_DATE_EPOCH=0", *kZone = "TZ=UTC0";

// The names in lines `#include "name"`.
std::vector<std::string> includedNames(const std::string& text) {
  std::vector<std::string> names;
  constexpr std::string_view kInclude = "#include \"";
  for (std::size_t at = text.find(kInclude); at != text.npos; at = text.find(kInclude, at + 1)) {
    const std::size_t first = at + kInclude.size(), end = text.find_first_of("\"\n", first);
    names.push_back(text.substr(first, end - first));
  }
  return names;
}

void showAll(std::vector<sandbox::Readable>& readable, const std::vector<fs::path>& paths) {
  for (const fs::path& path : paths) {
    const fs::path absolute = fs::absolute(path).lexically_normal();
    const bool ofSystem = absolute == "/" || absolute == "/usr" || absolute.string().starts_with("/usr/");
    if (!path.empty() && (isOwnFile(absolute) || !ofSystem) && fs::exists(absolute))
      readable.push_back({absolute, absolute});
  }
}

// A separately installed compiler, such as /opt/gcc/bin/g++, lies beside its libraries. One in ~/bin has much
// else beside it, so only these folders are shown.
std::vector<fs::path> placesOf(const fs::path& tool) {
  if (tool.parent_path().filename() != "bin") return {tool};
  const fs::path home = tool.parent_path().parent_path();
  return {home / "bin", home / "lib", home / "lib64", home / "libexec", home / "include"};
}

std::vector<sandbox::Readable> visibleFiles(const Toolchain& toolchain) {
  std::vector<sandbox::Readable> readable;
  for (std::size_t k = 1; k < toolchain.flags.size(); ++k) {
    if (toolchain.flags[k - 1] == "-isystem") showAll(readable, {toolchain.flags[k]});
    if (toolchain.flags[k - 1] == "-iquote") showAll(readable, studentHeaders(toolchain.flags[k]));
  }
  if (!toolchain.prefix.empty()) showAll(readable, {toolchain.prefix, toolchain.prefix.string() + ".gch"});
  showAll(readable, {toolchain.workerObject});
  if (!toolchain.show.empty()) showAll(readable, {toolchain.show});
  if (!toolchain.workerPart.empty())
    showAll(readable, {toolchain.workerPart, linkOptions(toolchain.workerPart)});
  for (const WorkerOfPart& part : workersOfParts(toolchain.workerPart))
    showAll(readable, {part.object, part.options});
  showAll(readable, toolchain.libraries);
  if (toolchain.compiler.starts_with('/')) showAll(readable, placesOf(toolchain.compiler));
  return readable;
}

sandbox::Confinement confinement(const Toolchain& toolchain, const fs::path& workFolder,
                                 const sandbox::Sandbox& sandbox, const ToolLimits& limits) {
  if (!isConfined(sandbox.level)) return {};
  return {.readable = visibleFiles(toolchain),
          .writable = workFolder,
          .environment = {"PATH=/usr/bin", "LC_ALL=C.UTF-8",
                          "TMPDIR=" +
                              (hasNamespaces(sandbox.level) ? sandbox::kInsideFolder : workFolder.string()),
                          kDate, kZone},
          .mayStartProgramsOfItsOwn = true,
          .cpuSeconds = limits.seconds,
          .wallSeconds = clockSeconds(limits.seconds, sandbox.level),
          .addressSpace = limits.memory,
          .fileSize = limits.fileSize,
          .openFiles = 256};
}

}  // namespace

double clockSeconds(double seconds, sandbox::Level level) {
  return (isConfined(level) ? 10 : 2) * seconds + 2;
}

BuildTools::BuildTools(const Toolchain& toolchain, const fs::path& workFolder,
                       const sandbox::Sandbox& sandbox, const ToolLimits& limits)
    : workFolder_(workFolder),
      limits_(limits),
      level_(sandbox.level),
      cell_(sandbox, confinement(toolchain, workFolder, sandbox, limits)) {}

// The sandbox itself ends after that wall-clock time and reports what was used. If it does not, we end it.
ProcessResult BuildTools::runConfined(const std::vector<std::string>& command,
                                      const ProcessOptions& options) const {
  ProcessOptions patient{
      .directory = options.directory, .timeout = options.timeout, .outputLimit = options.outputLimit};
  if (hasNamespaces(level_)) patient.timeout += 5;
  ProcessResult result = runProcess(cell_.command(command), patient);
  result.timedOut =
      result.timedOut || (hasNamespaces(level_) && result.exitCode == numberOf(ExitCode::kTimedOut));
  const std::string_view ready = sandbox::kReady;
  if (!result.started || !result.error.starts_with(ready))
    throw Error(
        {.what = fmt::format("cannot run {} in a sandbox of level {}", command.front(), numberOf(level_)),
         .found = result.error.substr(0, result.error.find('\n'))});
  result.error.erase(0, ready.size());
  return result;
}

ProcessResult BuildTools::runOnce(const std::vector<std::string>& command, std::size_t outputLimit) const {
  ProcessOptions options{.directory = workFolder_,
                         .environment = {kDate, kZone},
                         .timeout = clockSeconds(limits_.seconds, level_),
                         .outputLimit = outputLimit,
                         .cpuSeconds = limits_.seconds,
                         .addressSpace = limits_.memory,
                         .fileSize = limits_.fileSize};
  ProcessResult result = isConfined(level_) ? runConfined(command, options) : runProcess(command, options);
  if (!result.started) throw Error({.what = "cannot run " + command.front(), .found = result.error});
  // A compiler that was idle for so long is waiting for something that the source made it read. If it worked,
  // the machine was busy: otherwise the limit on processor time would have stopped it well before the clock.
  constexpr double kWorked = 0.2;  // as a share of the processor time that it may use
  if (result.timedOut && result.cpuSeconds > kWorked * limits_.seconds)
    throw Error({.what = fmt::format("{} did not end within {:g} s: the machine was too busy",
                                     command.front(), clockSeconds(limits_.seconds, level_))});
  return result;
}

// The kernel kills what exceeds its time by a second and, at level 3, what uses up its memory.
bool BuildTools::killedFromOutside(const ProcessResult& run) const {
  return wasKilled(run) && run.cpuSeconds < limits_.seconds && !cell_.ranOutOfMemory();
}

ProcessResult BuildTools::run(const std::vector<std::string>& command, std::size_t outputLimit) const {
  ProcessResult last = onceMoreIfKilled([&] { return runOnce(command, outputLimit); },
                                        [&](const ProcessResult& first) { return killedFromOutside(first); });
  if (killedFromOutside(last))
    throw Error(
        {.what = command.front() + " was killed twice, through no fault of the file",
         .found = fmt::format("{} after {:.1f} s of processor time", lastWordsOf(last), last.cpuSeconds),
         .wanted = "a machine with more free memory"});
  return last;
}

std::string BuildTools::limitReached(const ProcessResult& run) const {
  const auto says = [&](const char* text) { return run.error.find(text) != std::string::npos; };
  if (cell_.ranOutOfMemory() || says("out of memory") || says("memory exhausted") || says("bad_alloc"))
    return fmt::format("needed more than {} MiB of memory and was stopped", limits_.memory >> 20);
  // If the last words are lost among too many others, the time decides.
  if (wasKilled(run) || says("CPU time limit") || run.signal == SIGXCPU || run.cpuSeconds >= limits_.seconds)
    return fmt::format("took more than {:g} s of processor time and was stopped", limits_.seconds);
  if (says("File size limit") || says("File too large"))
    return fmt::format("would write a file of more than {} MiB", limits_.fileSize >> 20);
  return {};
}

void writeSource(const fs::path& file, const std::string& text) {
  writeTextFile(file, text);
  constexpr std::array<timespec, 2> kBeginning{};
  if (::utimensat(AT_FDCWD, file.c_str(), kBeginning.data(), 0) != 0)
    throw Error(
        {.what = "cannot set the time of a file", .where = {file.string()}, .found = std::strerror(errno)});
}

std::vector<fs::path> studentHeaders(const fs::path& folder) {
  std::vector<fs::path> found;
  const bool hasStarter = fs::exists(folder / "starter.cpp");
  std::vector<std::string> open = {"exercise.h", hasStarter ? "starter.cpp" : "main.cpp", "solution.cpp"};
  for (std::size_t k = 0; k < open.size(); ++k) {
    const fs::path file = folder / open[k];
    if (!fs::is_regular_file(fs::symlink_status(file))) continue;
    if (open[k].ends_with(".h")) found.push_back(file);
    for (const std::string& name : includedNames(readTextFile(file)))
      if (std::find(open.begin(), open.end(), name) == open.end() && name.find("..") == name.npos)
        open.push_back(name);
  }
  return found;
}

}  // namespace rex::grading
