#pragma once

#include <filesystem>

#include "grading/results.h"

namespace rex::grading {

/// Throws Error if the file cannot be read, and like gradeResultFromJson().
[[nodiscard]] GradeResult loadResult(const std::filesystem::path& file);

/// Replaces the file atomically: a reader sees either the old text or the new one, even after a power cut.
/// Throws Error if that fails.
void saveResult(const GradeResult& result, const std::filesystem::path& file);

}  // namespace rex::grading
