#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace rex {

/// The text with a to z for A to Z.
[[nodiscard]] std::string lowerCase(std::string_view text);

/// The ending of a file in small letters: ".urdf"; empty without one.
[[nodiscard]] std::string endingOf(const std::filesystem::path& file);

}  // namespace rex
