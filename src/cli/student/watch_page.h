#pragma once

#include <filesystem>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "cli/project.h"
#include "grading/results.h"
#include "live/live_server.h"
#include "submission/exercise_info.h"

namespace rex::cli {

/// The files of share/watch.
extern const char *const kWatchPage, *const kWatchStyle, *const kWatchScript;

/// Parts of the page of `rex watch` as HTML, in which all texts are escaped.

/// The whole page of an exercise, still without results: its task with formulas, points, and exercise.h. Only
/// links to the web and inside of the page remain.
[[nodiscard]] std::string emptyWatchPage(const submission::ExerciseInfo& exercise);

/// What visible checks now pass or fail, unlike before the last save.
[[nodiscard]] std::string newsPart(const grading::GradeResult& result,
                                   const std::optional<grading::GradeResult>& before);

/// A file that the page shows, by its path in the folder of results.
struct WatchFile {
  std::string name{};
  std::string bytes{};
};

/// Pictures and replays of checks, as far as they are among the files.
[[nodiscard]] std::string evidencePart(const grading::GradeResult& result,
                                       const std::vector<WatchFile>& files);

/// What the student's own program has drawn.
[[nodiscard]] std::string ownPart(const std::vector<WatchFile>& files);

/// The hints that were shown, by part, and buttons for the next ones.
[[nodiscard]] std::string hintsPart(const submission::ExerciseInfo& exercise,
                                    const std::map<std::string, int>& shownHints);

/// main.cpp with what the checks and the compiler say about its lines; `path` is where it is.
[[nodiscard]] std::string sourcePart(const grading::GradeResult& result, const std::string& source,
                                     const std::string& path);

/// The files that checks left, and those of the program: pictures, pages and films, at most thirty of at most
/// 8 MB.
[[nodiscard]] std::vector<WatchFile> filesOfChecks(const grading::GradeResult& result,
                                                   const std::filesystem::path& folder);
[[nodiscard]] std::vector<WatchFile> filesOfProgram(const std::filesystem::path& folder);

/// The page of `rex watch --open`: the exercise's task and functions, and after each grading its checks, what
/// happened in those that failed, hints to open, the program's own pictures, and main.cpp. It renews itself
/// when any of that changes; opening a hint counts as by `rex hint`.
class WatchPage {
 public:
  /// Serves it until it is destroyed. Keeps references to all arguments. Throws Error if the README or
  /// exercise.h cannot be read.
  WatchPage(const Project& project, const ExerciseInfo& exercise, LiveServer& server);
  ~WatchPage();
  WatchPage(const WatchPage&) = delete;
  WatchPage& operator=(const WatchPage&) = delete;

  /// Says that what was saved is being graded.
  void startGrading();
  /// Shows results.json, if there is one, and `text`, for people. Throws Error if it cannot be read.
  void renew(const std::string& text);

 private:
  void publish();
  void renewHints();
  void renewOwn();
  void hear(const std::string& message);
  void serve(const std::stop_token& stop);
  void renewWhatChanged();

  const Project& project_;
  const ExerciseInfo& exercise_;
  LiveServer& server_;
  std::filesystem::path folder_;

  std::mutex mutex_{};
  std::map<std::string, std::string> parts_{};  // by the id of their element
  std::string text_ = "The first grading has begun.";
  bool isBusy_ = true;
  std::string stamp_{};  // of the files that may change between gradings
  std::optional<grading::GradeResult> last_{};
  std::jthread listener_{};  // ends before what it uses
};

}  // namespace rex::cli
