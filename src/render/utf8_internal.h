#pragma once

#include <string>
#include <string_view>

namespace rex::internal {

/// The characters of UTF-8 text; each byte that is not part of a valid character becomes U+FFFD.
[[nodiscard]] std::u32string charactersOf(std::string_view text);

/// `text` as valid UTF-8 on one line: control characters and line breaks become spaces, invalid bytes '?'.
[[nodiscard]] std::string singleLine(std::string_view text);

}  // namespace rex::internal
