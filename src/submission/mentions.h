#pragma once

#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace rex::grading {

/// Whether a character may be part of a name.
[[nodiscard]] bool isWord(char c);

/// A C++ source with comments, literals and numbers replaced by blanks; all other characters keep their
/// positions.
[[nodiscard]] std::string codeOf(std::string_view source);

/// The names in a text that codeOf() made.
using Names = std::set<std::string, std::less<>>;
[[nodiscard]] Names namesIn(std::string_view code);

/// A C++ source after splicing lines that end in a backslash, and the original position of each character.
[[nodiscard]] std::pair<std::string, std::vector<std::size_t>> spliced(std::string_view source);

/// Line and column, from 1, of the only place outside comments, literals and the body of main() where a C++
/// source names the function, by the last part of its qualified name; 0, 0 if there are none or several.
[[nodiscard]] std::pair<int, int> onlyMentionOf(std::string_view function, std::string_view source);

/// The line, from 1, on which a C++ source defines a macro of that name, also across spliced lines; 0 if it
/// does not.
[[nodiscard]] int macroDefinitionLineOf(std::string_view name, std::string_view source);

/// The line, from 1, on which the definition of a function with that unqualified name begins; 0 if there is
/// none.
[[nodiscard]] int definitionLineOf(std::string_view function, std::string_view source);

/// Line and column, from 1, of the first place outside comments and literals where a C++ source reads
/// standard input with std::cin, stdin, scanf or getchar; 0, 0 if it does not.
[[nodiscard]] std::pair<int, int> standardInputUse(std::string_view source);

}  // namespace rex::grading
