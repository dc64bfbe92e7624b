#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "base/process.h"
#include "support/temporary_folder.h"

namespace rex::bench {

/// `rex watch` at work on an exercise, in a tree of its own with the graders of this build. Nearly all of the
/// solution is right, so that all checks run and the watching goes on.
class WatchedExercise {
 public:
  /// Waits for the first verdict. Throws Error as the parts of rex, and std::runtime_error without a verdict.
  WatchedExercise();

  /// Saves main.cpp; wall seconds until the result file is a new one.
  double saveToVerdict();
  /// Processor seconds of `rex test` on the same file, with all programs that it starts.
  [[nodiscard]] double testCpuSeconds() const;

 private:
  void save();
  void waitForNewResult();

  TemporaryFolder folder_;
  std::filesystem::path main_, results_;
  std::string source_;
  int saves_ = 0;
  std::optional<ChildProcess> rex_;
};

}  // namespace rex::bench
