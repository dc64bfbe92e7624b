#include "submission/build_tools.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <fstream>

#include <fcntl.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <sys/stat.h>
#include <sys/statvfs.h>

#include "base/error.h"
#include "base/exit_code.h"
#include "base/folders.h"
#include "base/text.h"
#include "base/text_file.h"
#include "sandbox/probes.h"
#include "submission/student_files.h"
#include "submission/worker_part.h"

namespace rex::submission {
namespace {

std::vector<std::filesystem::path> paths(const nlohmann::json& list) {
  const auto texts = list.get<std::vector<std::string>>();
  return {texts.begin(), texts.end()};
}

void replaceAll(std::string& text, std::string_view word, const std::string& by) {
  for (std::size_t at = text.find(word); at != text.npos; at = text.find(word, at + by.size()))
    text.replace(at, word.size(), by);
}

// A path as part of a text in JSON.
std::string inJson(const std::filesystem::path& path) {
  const std::string quoted = nlohmann::json(path.string()).dump();
  return quoted.substr(1, quoted.size() - 2);
}

}  // namespace

std::string installedText(std::string text) {
  if (text.find("{rex}") == text.npos) return text;
  replaceAll(text, "{include}", inJson(std::filesystem::weakly_canonical(ownFolder() / "include")));
  replaceAll(text, "{home}", inJson(homeFolder()));
  replaceAll(text, "{rex}", inJson(ownFolder()));
  return text;
}

Toolchain readToolchain(const std::filesystem::path& buildJson) {
  if (!std::filesystem::exists(buildJson))
    throw Error({.what = "the exercise is not built",
                 .where = {buildJson.string()},
                 .wanted = "this file, which building the project writes"});
  try {
    const nlohmann::json json = nlohmann::json::parse(installedText(readTextFile(buildJson)));
    return {.compiler = json.at("compiler").get<std::string>(),
            .flags = json.at("compile_flags").get<std::vector<std::string>>(),
            .linkFlags = json.at("link_flags").get<std::vector<std::string>>(),
            .workerObject = json.at("worker_object").get<std::string>(),
            .grader = json.at("grader").get<std::string>(),
            .libraries = paths(json.at("libraries")),
            .show = json.value("show", ""),
            .functions = json.at("functions").get<std::vector<std::string>>(),
            .prefix = json.value("prefix", ""),
            .workerPart = json.value("worker_part", ""),
            .offers = json.value("offers", ""),
            .objcopy = json.value("objcopy", "objcopy"),
            .objdump = json.value("objdump", "objdump")};
  } catch (const nlohmann::json::exception& error) {
    throw Error({.what = "not a build description", .where = {buildJson.string()}, .found = error.what()});
  }
}

namespace {

constexpr const char* kDriversEnd = "compilation terminated.";
constexpr auto kFull = std::to_array<const char*>({"No space left on device", "Disk quota exceeded"});

bool contains(std::string_view text, std::string_view part) { return text.find(part) != text.npos; }

bool tellsOfFullDisk(std::string_view line) {
  return std::any_of(kFull.begin(), kFull.end(), [&](const char* full) { return contains(line, full); });
}

// Whether a line is no help to a reader: an array of messages, perhaps empty, or one that introduces others.
bool tellsNothing(std::string_view line) {
  return line.empty() || line.starts_with('[') || line == kDriversEnd ||
         line.ends_with("Assembler messages:");
}

}  // namespace

// "student.o: in function `f':" introduces a line that explains it. Some lines start with the linker's name.
std::string complaintAbout(std::string_view object, std::string_view linkerText) {
  const std::string start = fmt::format("{}:", object), named = "ld: " + start;
  bool leads = false;
  for (const std::string_view line : splitLines(linkerText)) {
    if (contains(line, ": warning: ")) continue;
    if (leads) return std::string(line);
    const bool isAbout = line.starts_with(start) || contains(line, named);
    leads = isAbout && line.ends_with(':');
    if (isAbout && !leads) return std::string(line);
  }
  // The linker may then complain about other files, from which addresses are too far away.
  for (const char* words : {"relocation truncated to fit", "failed to convert GOTPCREL relocation"})
    if (contains(linkerText, words)) return "its global variables take more than 2 GB";
  return {};
}

bool blamesObject(std::string_view linkerText, std::string_view object) {
  return contains(linkerText, "undefined reference to `") ||
         contains(linkerText, "multiple definition of `") || !complaintAbout(object, linkerText).empty();
}

std::string lastLine(const ProcessResult& run) {
  std::string found;
  for (const std::string_view line : splitLines(run.error)) {
    if (tellsNothing(line)) continue;
    if (tellsOfFullDisk(line)) return std::string(line);
    if (found.empty()) found = line;
  }
  if (!found.empty()) return found;
  return run.signal != 0 ? fmt::format("signal {}", run.signal) : fmt::format("exit code {}", run.exitCode);
}

namespace {

namespace fs = std::filesystem;

// __DATE__ and __TIME__ are always the start of 1970 (reproducible-builds.org); __TIMESTAMP__: writeSource().
constexpr const char *kDate = "SOURCE_DATE_EPOCH=0", *kZone = "TZ=UTC0";

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
          .wallSeconds = clockSeconds(limits.seconds),
          .addressSpace = limits.memory,
          .fileSize = limits.fileSize,
          .openFiles = 256};
}

// No student's file has that name: see plainName().
constexpr const char *kControl = "_control.cpp", *kControlProgram = "_control";

std::vector<std::string> controlCommand(const Toolchain& toolchain) {
  std::vector<std::string> command = {toolchain.compiler};
  command.insert(command.end(), toolchain.flags.begin(), toolchain.flags.end());
  command.insert(command.end(), {kControl, "-o", kControlProgram});
  command.insert(command.end(), toolchain.linkFlags.begin(), toolchain.linkFlags.end());
  return command;
}

// How many processes the kernel has killed because memory was short, in all groups.
long oomKills() {
  std::ifstream counters("/proc/vmstat");
  std::string name;
  for (long count = 0; counters >> name >> count;)
    if (name == "oom_kill") return count;
  return 0;
}

// A file of ours among a tool's arguments that is not there; empty if all are.
std::string missingFile(const std::vector<std::string>& command, const fs::path& workFolder) {
  for (const std::string& word : command) {
    const fs::path file = word.starts_with('@') ? word.substr(1) : word;
    if (file.is_absolute() && !isBelow(workFolder, file) && !fs::exists(file)) return file.string();
  }
  return {};
}

}  // namespace

double clockSeconds(double seconds) { return 10 * seconds + 2; }

BuildTools::BuildTools(const Toolchain& toolchain, const fs::path& workFolder,
                       const sandbox::Sandbox& sandbox, const ToolLimits& limits)
    : workFolder_(workFolder),
      control_(controlCommand(toolchain)),
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
                         .timeout = clockSeconds(limits_.seconds),
                         .outputLimit = outputLimit,
                         .cpuSeconds = limits_.seconds,
                         .addressSpace = limits_.memory,
                         .fileSize = limits_.fileSize};
  ProcessResult result = isConfined(level_) ? runConfined(command, options) : runProcess(command, options);
  if (!result.started) throw Error({.what = "cannot run " + command.front(), .found = result.error});
  return result;
}

// A tool that did not end is not tried again: a file could hold up the grading in this way.
ProcessResult BuildTools::run(const std::vector<std::string>& command, const Explains& explains,
                              std::size_t outputLimit) const {
  // Killed in between in whatever group: a neighbour's misfortune explains one failure, hardly two.
  bool wereKilled = true;
  const auto runOnceMore = [&] {
    const long before = oomKills();
    ProcessResult ended = runOnce(command, outputLimit);
    wereKilled = wereKilled && !ended.timedOut && oomKills() > before;
    return ended;
  };
  const auto isExplained = [&](const ProcessResult& run) {
    return run.ok() || (!run.timedOut && !limitReached(run).empty()) || (explains && explains(run));
  };
  ProcessResult last = runOnceMore();
  if (!isExplained(last) && !last.timedOut) last = runOnceMore();
  if (isExplained(last)) return last;
  const std::string fault = faultOfMachine(command, last, wereKilled);
  if (fault.empty()) return last;
  throw Error({.what = fmt::format(
                   "{} {} through no fault of the file", command.front(),
                   last.timedOut ? fmt::format("did not end within {:g} s", clockSeconds(limits_.seconds))
                                 : "failed twice"),
               .found = fmt::format("{}; {}", fault, lastLine(last)),
               .wanted = "a machine with free memory and disk space, and working tools"});
}

// What the system says, and whether the same tools build an empty program now. No words of a tool count,
// since a file can make it say anything. If they do build it, the file is to blame.
std::string BuildTools::faultOfMachine(const std::vector<std::string>& command, const ProcessResult& failure,
                                       bool wereKilled) const {
  if (wereKilled) return "the kernel killed a process because memory was short";
  if (const std::string free = shortOfDisk(); !free.empty()) return free;
  if (const std::string missing = missingFile(command, workFolder_); !missing.empty())
    return "no file " + missing;
  writeSource(workFolder_ / kControl, "int main() {}\n");
  const auto start = std::chrono::steady_clock::now();
  const ProcessResult control = runOnce(control_);
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
  for (const char* file : {kControl, kControlProgram}) fs::remove(workFolder_ / file);
  if (!control.ok()) return "an empty program cannot be built either";
  // At the speed of the empty program, the tool would have taken so long for the work that it did. If that is
  // much less than it had, it did not work but wait, for something that the file made it read.
  const double expected = failure.cpuSeconds * took.count() / std::max(control.cpuSeconds, 0.01);
  return failure.timedOut && expected > clockSeconds(limits_.seconds) / 2 ? "the machine was too busy" : "";
}

// Confined tools write temporary files to memory, or into the work folder.
std::string BuildTools::shortOfDisk() const {
  std::vector<fs::path> folders = {workFolder_};
  if (!isConfined(level_)) folders.push_back(fs::temp_directory_path());
  for (const fs::path& folder : folders) {
    struct statvfs disk {};
    if (::statvfs(folder.c_str(), &disk) != 0)
      return fmt::format("{}: {}", folder.string(), std::strerror(errno));
    const auto free = static_cast<std::size_t>(disk.f_bavail) * disk.f_frsize;
    if (free < limits_.fileSize) return fmt::format("{} KiB free in {}", free >> 10, folder.string());
  }
  return {};
}

// Some of these words may be the file's: it can only blame itself by them.
std::string BuildTools::limitReached(const ProcessResult& run) const {
  const auto says = [&](const char* text) { return run.error.find(text) != std::string::npos; };
  if (cell_.ranOutOfMemory() || says("out of memory") || says("memory exhausted") || says("bad_alloc"))
    return fmt::format("needed more than {} MiB of memory and was stopped", limits_.memory >> 20);
  // If the last words are lost among too many others, the time decides.
  if (says("CPU time limit") || run.signal == SIGXCPU || run.cpuSeconds >= limits_.seconds)
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
  const bool hasStarter = fs::exists(folder / "starter.cpp");
  std::vector<fs::path> found;
  for (const std::string& name :
       filesIncludedFrom(folder, {"exercise.h", hasStarter ? "starter.cpp" : "main.cpp", "solution.cpp"}))
    if (name.ends_with(".h")) found.push_back(folder / name);
  return found;
}

}  // namespace rex::submission
