#pragma once
// Where the copies of a grader leave what they heard in visible checks, for the questions about known
// mistakes.
//   heard.keep(k, {calls, judge.asked()});                  // in the copy that judges check k
//   heard.askAboutMistakes(job, checks);                    // when all copies have ended
#include <cstddef>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "grading/grading_job.h"
#include "grading/known_mistakes.h"
#include "grading/results.h"

namespace rex::grading {

/// What was heard in one check.
struct Heard {
  std::vector<SketchedCall> calls{};
  std::string asked{};  ///< the question at the end of the message; empty: none
};

/// Keeps it in files.
class HeardChecks {
 public:
  explicit HeardChecks(std::filesystem::path folder) : folder_(std::move(folder)) {}

  void keep(std::size_t check, const Heard& heard) const;

  /// Writes the sketches of the job, and lets visible checks that failed ask about its known mistakes.
  /// Returns whether a message has changed. A question helps but decides nothing: if files cannot be read,
  /// the messages stay as they are.
  bool askAboutMistakes(const GradingJob& job,
                        const std::vector<std::pair<std::size_t, CheckResult*>>& checks) const;

 private:
  std::filesystem::path file(std::size_t check, const char* ending) const;

  std::filesystem::path folder_;
};

}  // namespace rex::grading
