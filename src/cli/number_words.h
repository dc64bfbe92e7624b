#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace rex::cli {

/// Throws an error about a text: what was found, what was wanted.
using Refusal = std::function<void(const std::string&, const std::string&)>;

/// Throws a UsageError that begins with the option.
[[nodiscard]] Refusal refusalOf(const std::string& option);

/// The words of a text, separated by commas or blanks; a final comma is allowed. Refuses empty fields and
/// ';'.
[[nodiscard]] std::vector<std::string> numberWords(std::string_view text, const Refusal& refuse);

/// Whether a word is a numeral; "nan" and "inf" are, too.
[[nodiscard]] bool isNumeral(std::string_view word, double& number);

/// The finite number that a word stands for; empty for other words.
[[nodiscard]] std::optional<double> numberIn(std::string_view word);

}  // namespace rex::cli
