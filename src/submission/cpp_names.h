#pragma once

#include <cstddef>
#include <set>
#include <string>
#include <string_view>
#include <utility>

#include "submission/cpp_text.h"

namespace rex::submission {

/// The names among some tokens of a C++ source, from `first` to the one before `end`.
using Names = std::set<std::string, std::less<>>;
[[nodiscard]] Names namesIn(const CppText& text, std::size_t first, std::size_t end);

/// Line and column, from 1, of the only mention of the function outside comments, literals and main(), by the
/// last part of its qualified name; 0, 0 if there are none or several.
[[nodiscard]] std::pair<int, int> onlyMention(std::string_view function, const CppText& text);

/// The line, from 1, on which a C++ source defines a macro of that name, also across spliced lines; 0 if it
/// does not.
[[nodiscard]] int macroDefinitionLine(std::string_view name, std::string_view source);

/// The line, from 1, on which the definition of a function with that unqualified name begins; 0 if there is
/// none.
[[nodiscard]] int definitionLine(std::string_view function, const CppText& text);

/// Line and column, from 1, of the first place outside comments and literals where a C++ source reads
/// standard input with std::cin, stdin, scanf or getchar; 0, 0 if it does not.
[[nodiscard]] std::pair<int, int> standardInputUse(const CppText& text);

}  // namespace rex::submission
