#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace rex::grading {

/// The whole file. Throws Error when it cannot be read.
[[nodiscard]] std::string readTextFile(const std::filesystem::path& file);

/// Makes or replaces the file, in folders made where missing. Throws Error when that fails.
void writeTextFile(const std::filesystem::path& file, std::string_view text);

}  // namespace rex::grading
