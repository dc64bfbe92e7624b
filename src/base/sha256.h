#pragma once

#include <string>
#include <string_view>

namespace rex {

/// The SHA-256 hash of the bytes as 64 lower-case hexadecimal digits.
[[nodiscard]] std::string sha256(std::string_view bytes);

}  // namespace rex
