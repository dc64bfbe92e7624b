#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace rex::cli {

/// Throws what is wrong with a text: what was found, what was wanted.
using Refusal = std::function<void(const std::string&, const std::string&)>;

/// Throws a UsageError that begins with the option.
[[nodiscard]] Refusal refusalOf(const std::string& option);

/// The words of a text, between commas or blanks; a comma may stand at its end. Refuses empty fields and ';'.
[[nodiscard]] std::vector<std::string> numberWords(std::string_view text, const Refusal& refuse);

/// Whether a word is a number for a computer; also "nan" and "inf" are.
[[nodiscard]] bool isNumeral(std::string_view word, double& number);

/// The finite number that a word is; nothing for another word.
[[nodiscard]] std::optional<double> numberIn(std::string_view word);

}  // namespace rex::cli
