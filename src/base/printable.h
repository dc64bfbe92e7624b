#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace rex {

/// Whether a character has no look of its own, or bends that of its neighbours: control and format characters
/// (Unicode's categories Cc and Cf), line and paragraph separators, what programs may ignore
/// (Default_Ignorable_Code_Point), and codes that are never characters. Newline and tab are such, too.
[[nodiscard]] bool isInvisible(char32_t character);

/// The one door for text of strangers, before an escaper of base/escape.h: valid UTF-8 of at most `limit`
/// bytes, in which U+FFFD stands for every invalid byte and every isInvisible() character but newline and
/// tab. Applied twice it changes nothing more.
[[nodiscard]] std::string printable(std::string_view text, std::size_t limit = std::string_view::npos);

}  // namespace rex
