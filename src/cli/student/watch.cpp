#include <chrono>
#include <cstdio>
#include <memory>
#include <string>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "base/error.h"
#include "cli/file_watcher.h"
#include "cli/open_browser.h"
#include "cli/student/exercise_option_internal.h"
#include "cli/student/keyboard.h"
#include "cli/student/student_room_internal.h"
#include "cli/student/test_one.h"
#include "cli/student/watch_keys.h"
#include "cli/student/watch_page.h"
#include "cli/terminal.h"

namespace rex::cli {
namespace {

struct WatchOptions {
  std::string exercise;
  bool poll = false;  ///< do not use inotify
  bool open = false;  ///< also as a page
};

// Grades like `rex test`, only `check` unless that is empty. Reports a fault of the project, which may be
// repaired while watching.
ExitCode gradeOnce(const Project& project, const std::string& name, const std::string& check) {
  const auto start = std::chrono::steady_clock::now();
  ExitCode code = ExitCode::kGraderFault;
  try {
    TestOptions options;
    options.exercise = name;
    if (!check.empty()) options.job.checks = {check};
    code = testOne(project, options);
  } catch (const std::exception& error) {
    note(wrap(fmt::format("rex: {}", error.what()), 2, 0));
  }
  const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
  say(fmt::format("graded in {:.1f} s", taken.count()));
  return code;
}

// The page of `--open`, which is opened as soon as there is a result.
class ResultPage {
 public:
  ResultPage(const Project& project, const ExerciseInfo& exercise, bool isWanted)
      : page_(project.outFolder(exercise, false), exercise.folder / "main.cpp"), isWanted_(isWanted) {}

  void renew() {
    try {
      if (!isWanted_ || !page_.renew() || isOpen_) return;
    } catch (const Error& error) {
      note(wrap(fmt::format("rex: {}", error.what()), 2, 0));
      return;
    }
    isOpen_ = true;
    say("page: " + shown(page_.file()));
    if (hasScreen()) openInBrowser(std::filesystem::absolute(page_.file()).string());
  }

 private:
  WatchPage page_;
  bool isWanted_, isOpen_ = false;
};

void separate() { say("\n" + std::string(80, '-')); }

std::string nextExercise(const Project& project, const std::string& name) {
  const std::vector<ExerciseInfo> all = project.exercises();
  for (std::size_t k = 0; k + 1 < all.size(); ++k)
    if (all[k].name == name) return all[k + 1].name;
  return "";
}

// Watches one exercise. Returns the name of the next one to watch, or "" to end.
std::string watchOne(const Project& project, const ExerciseInfo& exercise, const WatchOptions& options,
                     const Keyboard& keyboard, ExitCode& code) {
  const std::filesystem::path main = exercise.folder / "main.cpp";
  FileWatcher watcher(main, options.poll ? FileWatcher::Method::kPolling : FileWatcher::Method::kInotify);
  ResultPage page(project, exercise, options.open);
  WatchKeys keys(project, exercise, keyboard, watcher);
  say(fmt::format("watching {} by {}; press Ctrl-C to end", shown(main), watcher.describe()));
  std::fflush(stdout);
  for (;;) {
    code = gradeOnce(project, exercise.name, keys.check());
    page.renew();
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
  ExitCode code = ExitCode::kBelow;
  std::string name = project.exercise(options.exercise).name;
  while (!name.empty()) name = watchOne(project, project.exercise(name), options, keyboard, code);
  return code;
}

}  // namespace

void addWatch(CLI::App* command, Action& action) {
  const auto options = std::make_shared<WatchOptions>();
  command->footer(
      "Example: scripts/rex watch 01\n\n"
      "Notices saves by inotify, or by polling five times a second if that fails, and says which.\n"
      "--open shows the result in your browser, too: checks, pictures of failed ones, replays,\n"
      "and what has changed since the last save.\n"
      "In a terminal single keys give hints and more; elsewhere it ends at the full score.");
  addExercise(command, options->exercise);
  command->add_flag("--open", options->open, "also show the result as a page that renews itself");
  command->add_flag("--poll", options->poll, "poll the file instead of using inotify");
  command->callback(
      [&action, options] { action = [options](const Project& p) { return watch(p, *options); }; });
}

}  // namespace rex::cli
