#pragma once

#include <string>
#include <string_view>

namespace rex {

/// Bytes as text in base 64, with padding (RFC 4648).
[[nodiscard]] std::string base64(std::string_view bytes);

}  // namespace rex
