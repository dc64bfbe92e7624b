#pragma once

#include <filesystem>
#include <string>

#include "grading/submission.h"

namespace rex::grading {

/// What buildSubmission() gives, taken from `folder` where an earlier call with the same key left it, else
/// built and left there; what does not compile is built each time. The key must tell apart all that a build
/// depends on. Only the grader's user may write in the folder: it holds programs. Several gradings may share
/// it. Throws Error if the folder cannot be written.
[[nodiscard]] BuiltSubmission buildOnce(const std::filesystem::path& folder, const std::string& key,
                                        const Toolchain& toolchain, const ExerciseInfo& exercise,
                                        const SubmissionOptions& options);

}  // namespace rex::grading
