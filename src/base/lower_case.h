#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace rex {

/// The text with A to Z replaced by a to z.
[[nodiscard]] std::string lowerCase(std::string_view text);

/// The extension of a file in lower case: ".urdf"; empty if there is none.
[[nodiscard]] std::string endingOf(const std::filesystem::path& file);

}  // namespace rex
