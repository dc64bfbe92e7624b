#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace rex {

/// Seconds since 1970 in UTC of "2026-11-20T23:59:00+01:00" or "... Z"; nothing for any other text, for a
/// time without a zone, or for a day that does not exist.
[[nodiscard]] std::optional<std::int64_t> parseInstant(std::string_view text);

/// "2026-11-20T22:59:00Z".
[[nodiscard]] std::string instantText(std::int64_t seconds);

}  // namespace rex
