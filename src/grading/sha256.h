#pragma once

#include <string>
#include <string_view>

namespace rex::grading {

/// The SHA-256 hash of the bytes as 64 lower-case hexadecimal digits (FIPS 180-4).
[[nodiscard]] std::string sha256(std::string_view bytes);

}  // namespace rex::grading
