#pragma once

#include <string>
#include <string_view>

namespace rex::internal {

/// Bytes packed as a gzip file without name and time: the same bytes each time.
[[nodiscard]] std::string gzip(std::string_view bytes);

}  // namespace rex::internal
