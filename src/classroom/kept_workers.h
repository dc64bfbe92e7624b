#pragma once

#include <filesystem>
#include <string>

#include "submission/submission.h"

namespace rex::grading {

/// The compiler's output for a submission, next to its result.
inline constexpr const char* kBuildLog = "build.log";

/// Where programs are kept. The key must depend on everything that a build depends on. Only the grader's
/// user may write to the folder, because programs in it are run. Several gradings may share it.
struct KeptWorkers {
  std::filesystem::path folder{};
  std::string key{};
  bool anew = false;  ///< build even if it is kept
};

/// The result of buildSubmission(), taken from the folder if an earlier call with the same key left it
/// there, else built and stored. Files that do not compile are built each time, and so are programs with a
/// wrong hash. Throws Error if the folder cannot be written.
[[nodiscard]] BuiltSubmission buildOnce(const KeptWorkers& keeping, const Toolchain& toolchain,
                                        const ExerciseInfo& exercise, const SubmissionOptions& options);

}  // namespace rex::grading
