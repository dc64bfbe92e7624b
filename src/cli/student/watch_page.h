#pragma once

#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "cli/project.h"
#include "grading/results.h"
#include "live/live_server.h"

namespace rex::cli {

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
