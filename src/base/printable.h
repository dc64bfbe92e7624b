#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace rex {

/// Text of a student's program made safe for reports and terminals: valid UTF-8 of at most `limit` bytes, in
/// which U+FFFD stands for every invalid byte and every control character but newline and tab.
[[nodiscard]] std::string printable(std::string_view text, std::size_t limit);

}  // namespace rex
