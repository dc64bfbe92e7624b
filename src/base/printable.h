#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace rex {

/// Whether a character is invisible or changes the look of its neighbours: control and format characters
/// (Unicode's categories Cc and Cf), line and paragraph separators, characters that programs may ignore
/// (Default_Ignorable_Code_Point), and codes that are never characters. This includes newline and tab.
[[nodiscard]] bool isInvisible(char32_t character);

/// The single entry for untrusted text, before an escaper of base/escape.h: valid UTF-8 of at most `limit`
/// bytes, in which U+FFFD replaces every invalid byte and every isInvisible() character except newline and
/// tab. Applying it twice changes nothing more.
[[nodiscard]] std::string printable(std::string_view text, std::size_t limit = std::string_view::npos);

}  // namespace rex
