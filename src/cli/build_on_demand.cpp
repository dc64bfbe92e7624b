#include "cli/build_on_demand.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <optional>

#include <fmt/format.h>

#include "base/folders.h"
#include "base/process.h"
#include "base/text.h"
#include "base/text_file.h"
#include "cli/out_folder.h"
#include "cli/terminal.h"

namespace rex::cli {
namespace {

namespace fs = std::filesystem;

constexpr double kNoTimeout = 1e6;  // seconds

struct Steps {
  int done = 0;
  int all = 0;
};

// "[12/40] Building ..." as NINJA_STATUS asks for.
std::optional<Steps> stepsIn(std::string_view line) {
  if (!line.starts_with('[')) return {};
  line.remove_prefix(1);
  const std::optional<int> done = takeNumber<int>(line);
  if (!done || !line.starts_with('/')) return {};
  line.remove_prefix(1);
  const std::optional<int> all = takeNumber<int>(line);
  if (!all || !line.starts_with(']') || *all < 1) return {};
  return Steps{*done, *all};
}

std::optional<Steps> lastSteps(std::string_view log) {
  while (!log.empty()) {
    const std::size_t start = log.find_last_of('\n') + 1;  // 0 if there is none
    if (const auto steps = stepsIn(log.substr(start))) return steps;
    log = log.substr(0, start == 0 ? 0 : start - 1);
  }
  return {};
}

// Rounded, as the estimate is rough.
std::string leftOf(double seconds) {
  if (seconds < 90) return fmt::format("about {:.0f} s left", 5 * std::max(1., std::round(seconds / 5)));
  return fmt::format("about {:.0f} min left", std::round(seconds / 60));
}

std::string lastLines(const std::string& text, std::size_t size) {
  if (text.size() <= size) return text;
  return text.substr(text.find('\n', text.size() - size) + 1);
}

std::string textOf(const fs::path& log) { return fs::exists(log) ? readTextFile(log) : ""; }

std::vector<std::string> ninja(const Project& project, const std::vector<std::string>& targets) {
  std::vector<std::string> command = {"ninja", "-C", project.build.string()};
  command.insert(command.end(), targets.begin(), targets.end());
  return command;
}

bool isUpToDate(const Project& project, const std::vector<std::string>& targets) {
  std::vector<std::string> command = ninja(project, targets);
  // Only says what would be done. It would also take away what a compiler under way has just written about
  // the headers that it read: the other build would never look at them again.
  command.insert(command.end(), {"-n", "-d", "keepdepfile"});
  const ProcessResult told = runProcess(command, {.timeout = kNoTimeout});
  return told.ok() && told.output.find("no work to do") != std::string::npos;
}

// The shell is only there to redirect the output, so that the log can be read while it grows.
ProcessResult build(const Project& project, const std::vector<std::string>& targets, const fs::path& log) {
  std::vector<std::string> command = {"env",   "NINJA_STATUS=[%f/%t] ",           "sh",
                                      "-c",    R"(exec "$@" >"$0" 2>&1)",         log.string(),
                                      "flock", (project.build / ".lock").string()};
  for (std::string& word : ninja(project, targets)) command.push_back(std::move(word));
  return runProcess(command, {.timeout = kNoTimeout});
}

}  // namespace

void bringUpToDate(const Project& project, const std::vector<std::string>& targets, const std::string& what) {
  if (!fs::exists(project.build / "build.ninja") || isUpToDate(project, targets)) return;
  note(fmt::format("building {} ...", what));
  const PrivateFolder folder(temporaryFolder());
  const fs::path log = folder.path() / "build.log";
  const auto start = std::chrono::steady_clock::now();
  const ProcessResult built = [&] {
    const ProgressLine line([&] {
      const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
      return buildProgress(what, textOf(log), taken.count());
    });
    return build(project, targets, log);
  }();
  if (built.ok()) return;
  constexpr std::size_t kShown = 6000;
  throw BuildFailure(
      fmt::format("{} does not build:\n{}{}", what, lastLines(textOf(log), kShown), built.error));
}

std::string buildProgress(const std::string& what, std::string_view log, double seconds) {
  std::string text = "building " + what;
  const std::optional<Steps> steps = lastSteps(log);
  if (!steps) return text;
  text += fmt::format(": {} %", 100 * steps->done / steps->all);
  // The first steps say little about the others.
  constexpr double kKnown = 3;
  const int left = steps->all - steps->done;
  if (steps->done > 0 && left > 0 && seconds >= kKnown) text += ", " + leftOf(seconds * left / steps->done);
  return text;
}

}  // namespace rex::cli
