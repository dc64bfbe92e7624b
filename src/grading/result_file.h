#pragma once

#include <filesystem>
#include <string>

#include "grading/results.h"

namespace rex::grading {

/// Throws Error if the file cannot be read, and like gradeResultFromJson().
[[nodiscard]] GradeResult loadResult(const std::filesystem::path& file);

/// loadResult() for those who rely on the points. Throws Error, too, if they do not add up, if the outcome
/// does not fit the checks, or if the text was changed since it was sealed: see sealOf().
[[nodiscard]] GradeResult loadSoundResult(const std::filesystem::path& file);

/// The hash of all that counts in the text of a result: everything but `volatile` and `inputs`. Bulk grading
/// keeps it as `inputs.result_sha256`. Throws Error if the text is not JSON.
[[nodiscard]] std::string sealOf(const std::string& text, const std::string& file);

/// Replaces the file atomically: a reader sees either the old text or the new one, even after a power cut.
/// Throws Error if that fails.
void saveResult(const GradeResult& result, const std::filesystem::path& file);

}  // namespace rex::grading
