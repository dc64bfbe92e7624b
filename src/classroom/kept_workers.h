#pragma once
// Compiled programs of students, which are kept for other seeds and for a second pass:
//   const submission::BuiltSubmission built =
//       classroom::buildOnce({.folder = "kept", .key = key}, toolchain, exercise, options);
//   if (built.worker.empty()) return built.start;  // it does not compile

#include <filesystem>
#include <string>

#include "submission/build_tools.h"
#include "submission/exercise_info.h"
#include "submission/submission.h"

namespace rex::classroom {

/// Where programs are kept. Only the grader's user may write to the folder, because programs in it are run.
/// Several gradings may share it.
struct KeptWorkers {
  std::filesystem::path folder{};
  std::string key{};       ///< depends on everything that a build depends on
  bool recompile = false;  ///< build even if it is kept
};

/// The result of buildSubmission(), taken from the folder if an earlier call with the same key left it
/// there, else built and stored. Files that do not compile are built each time, and so are programs with a
/// wrong hash. Throws Error if the folder cannot be written.
[[nodiscard]] submission::BuiltSubmission buildOnce(const KeptWorkers& keeping,
                                                    const submission::Toolchain& toolchain,
                                                    const submission::ExerciseInfo& exercise,
                                                    const submission::SubmissionOptions& options);

}  // namespace rex::classroom
