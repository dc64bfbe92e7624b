#include <chrono>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "base/error.h"
#include "base/folders.h"
#include "cli/command_table.h"
#include "cli/file_watcher.h"
#include "cli/option_table_internal.h"
#include "cli/out_folder.h"
#include "cli/student/test_run.h"
#include "cli/student/watch_keys.h"
#include "cli/student/watch_page.h"
#include "cli/terminal.h"
#include "live/live_server.h"
#include "live/open_browser.h"
#include "submission/student_build.h"

namespace rex::cli {
namespace {

struct WatchOptions {
  std::string exercise;
  std::string check;  ///< see TestOptions; empty: all
  bool poll = false;  ///< do not use inotify
  bool open = false;  ///< also as a page
};

// The address of `--open`, which the pages of all exercises that are watched have in common.
class WatchAddress {
 public:
  WatchAddress() : server_({}), folder_(temporaryFolder()) {
    say("page: " + server_.url());
    const std::string more = bringToUser(server_, &folder_);
    if (!more.empty()) say(more);
    std::fflush(stdout);
  }
  [[nodiscard]] LiveServer& server() { return server_; }

 private:
  LiveServer server_;
  PrivateFolder folder_;  // while the browser reads it
};

// Shows each grading if there is a page.
class ResultPage {
 public:
  ResultPage(const Project& project, const ExerciseInfo& exercise, WatchAddress* address) {
    if (address != nullptr) page_.emplace(project, exercise, address->server());
  }

  void startGrading() {
    if (page_) page_->startGrading();
  }
  void renew(const std::string& text) {
    try {
      if (page_) page_->renew(text);
    } catch (const Error& error) {
      note(wrap(fmt::format("rex: {}", error.what()), 2, 0));
    }
  }

 private:
  std::optional<WatchPage> page_{};
};

// Empty if it cannot be read, which the grading says.
std::string textOf(const std::filesystem::path& file) {
  try {
    return submission::readStudentFile(file);
  } catch (const Error&) {
    return {};
  }
}

// Grades like `rex test`, only `check` unless that is empty; `before` is the file of the last whole test, or
// of the first. Reports a fault of the project, which may be repaired while watching. Throws UsageError if
// nothing was graded yet, for a check that does not exist.
ExitCode gradeOnce(const Project& project, const ExerciseInfo& exercise, const std::string& check,
                   std::optional<std::string>& before, ResultPage& page) {
  page.startGrading();
  const auto start = std::chrono::steady_clock::now();
  ExitCode code = ExitCode::kGraderFault;
  try {
    TestOptions options;
    options.exercise = exercise.name;
    if (!check.empty()) options.job.checks = {check};
    options.saved = {.before = before.value_or(""), .now = textOf(exercise.folder / "main.cpp")};
    code = testOne(project, options);
    if (check.empty() || !before) before = options.saved.now;
  } catch (const std::exception& error) {
    if (!before && dynamic_cast<const UsageError*>(&error) != nullptr) throw;
    note(wrap(fmt::format("rex: {}", error.what()), 2, 0));
  }
  const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
  const std::string graded = fmt::format("graded in {:.1f} s", taken.count());
  say(graded);
  page.renew(code == ExitCode::kGraderFault ? "could not be graded: see the terminal" : graded);
  return code;
}

void separate() { say("\n" + std::string(80, '-')); }

std::string nextExercise(const Project& project, const std::string& name) {
  const std::vector<ExerciseInfo> all = project.exercises();
  for (std::size_t k = 0; k + 1 < all.size(); ++k)
    if (all[k].name == name) return all[k + 1].name;
  return "";
}

// Watches one exercise. Returns the name of the next one to watch, or "" to end.
std::string watchOne(const Project& project, const ExerciseInfo& exercise, const WatchOptions& options,
                     const Keyboard& keyboard, WatchAddress* address, ExitCode& code) {
  const std::filesystem::path main = exercise.folder / "main.cpp";
  FileWatcher watcher(main, options.poll ? FileWatcher::Method::kPolling : FileWatcher::Method::kInotify);
  ResultPage page(project, exercise, address);
  WatchKeys keys(project, exercise, keyboard, watcher, options.check);
  say(fmt::format("watching {} by {}; press Ctrl-C to end", shown(main), watcher.describe()));
  std::fflush(stdout);
  for (std::optional<std::string> before;;) {
    code = gradeOnce(project, exercise, keys.check(), before, page);
    const bool isSolved = code == ExitCode::kFull && keys.check().empty();
    std::fflush(stdout);
    if (keyboard.isThere()) {
      const WatchKeys::Wish wish = keys.obey(isSolved);
      if (wish == WatchKeys::Wish::kQuit) return "";
      if (wish == WatchKeys::Wish::kNext) return nextExercise(project, exercise.name);
    } else {
      if (isSolved) return "";  // there is no keyboard to quit with
      static_cast<void>(watcher.wait());
    }
    separate();
  }
}

// Grades now and after each save. Without a keyboard it ends by itself at the full score.
ExitCode watch(const Project& project, const WatchOptions& options) {
  const Keyboard keyboard;
  std::optional<WatchAddress> address;
  if (options.open) address.emplace();
  ExitCode code = ExitCode::kBelow;
  std::string name = project.exercise(options.exercise).name;
  for (WatchOptions one = options; !name.empty(); one.check.clear())
    name = watchOne(project, project.exercise(name), one, keyboard, address ? &*address : nullptr, code);
  return code;
}

}  // namespace

void addWatch(CLI::App* command, Action& action) {
  const auto options = std::make_shared<WatchOptions>();
  command->footer(
      "Example: scripts/rex watch 01\n\n"
      "Notices saves by inotify, or by polling five times a second if that fails, and says which.\n"
      "--open serves the exercise as a page, too: task, functions, hints to open, checks, replays\n"
      "of failed ones, and what has changed since the last save; only this machine can read it.\n"
      "In a terminal single keys give hints and more; elsewhere it ends at the full score.");
  addExercise(command, options->exercise);
  addOptions(command, {{"--check", options->check, "NAME", "only this check, part or failed function"},
                       {"--open", options->open, "also show the exercise as a page that renews itself"},
                       {"--poll", options->poll, "poll the file instead of using inotify"}});
  command->callback(
      [&action, options] { action = [options](const Project& p) { return watch(p, *options); }; });
}

}  // namespace rex::cli
