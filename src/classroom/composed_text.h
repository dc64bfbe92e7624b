#pragma once

#include <string>
#include <string_view>

namespace rex::grading {

/// The text in Unicode's composed form (NFC), so that an umlaut is one character wherever it was typed. A
/// text that is not UTF-8 comes back as it is.
[[nodiscard]] std::string composed(std::string_view text);

/// composed() without differences of case, to compare names and addresses.
[[nodiscard]] std::string caseless(std::string_view text);

[[nodiscard]] bool isUtf8(std::string_view text);

}  // namespace rex::grading
