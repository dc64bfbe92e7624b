#pragma once

#include <filesystem>
#include <string>

#include "submission/submission.h"

namespace rex::grading {

/// What the compiler said of a submission, beside its result.
inline constexpr const char* kBuildLog = "build.log";

/// Where programs are kept. The key must tell apart all that a build depends on. Only the grader's user may
/// write in the folder: it holds programs. Several gradings may share it.
struct KeptWorkers {
  std::filesystem::path folder{};
  std::string key{};
  bool anew = false;  ///< build whatever is kept
};

/// What buildSubmission() gives, taken from the folder where an earlier call with the same key left it, else
/// built and left there. What does not compile is built each time, and so is what is damaged, by its hash.
/// Throws Error if the folder cannot be written.
[[nodiscard]] BuiltSubmission buildOnce(const KeptWorkers& keeping, const Toolchain& toolchain,
                                        const ExerciseInfo& exercise, const SubmissionOptions& options);

}  // namespace rex::grading
