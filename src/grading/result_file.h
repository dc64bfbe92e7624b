#pragma once

#include <filesystem>

#include "grading/results.h"

namespace rex::grading {

/// Throws Error if the file cannot be read, or as gradeResultFromJson().
[[nodiscard]] GradeResult loadResult(const std::filesystem::path& file);

/// Replaces the file at once: a reader sees the old text or the new one, also after a power cut. Throws
/// Error.
void saveResult(const GradeResult& result, const std::filesystem::path& file);

}  // namespace rex::grading
