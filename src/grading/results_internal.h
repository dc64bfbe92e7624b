#pragma once
// For readers of result files that have parsed the text already.
#include <filesystem>
#include <string>

#include <nlohmann/json.hpp>

#include "grading/results.h"

namespace rex::grading {

/// gradeResultFromJson() of a text that was parsed without exceptions.
[[nodiscard]] GradeResult resultFromParsed(const nlohmann::ordered_json& json, const std::string& file);

/// Throws what loadSoundResult() does for a result that it does not believe.
void requireSound(const GradeResult& result, const nlohmann::ordered_json& json,
                  const std::filesystem::path& file);

}  // namespace rex::grading
