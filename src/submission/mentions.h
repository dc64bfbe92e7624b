#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace rex::grading {

/// Whether a character may stand in a name.
[[nodiscard]] bool isWord(char c);

/// A C++ source with blanks for comments, literals and numbers; every character keeps its place.
[[nodiscard]] std::string codeOf(std::string_view source);

/// A C++ source without backslashes at the ends of lines and what follows them, and where each character of
/// it stood.
[[nodiscard]] std::pair<std::string, std::vector<std::size_t>> spliced(std::string_view source);

/// Line and column, from 1, of the only place outside comments, literals and the body of main() where a C++
/// source names the function, by the last part of its qualified name; 0, 0 when there is none or several.
[[nodiscard]] std::pair<int, int> onlyMentionOf(std::string_view function, std::string_view source);

/// The line, from 1, on which a C++ source defines a macro of that name, also in a line that goes on in the
/// next; 0 when it does not.
[[nodiscard]] int macroDefinitionLineOf(std::string_view name, std::string_view source);

/// The line, from 1, on which a C++ source begins to define a function of that plain name; 0 when it does
/// not.
[[nodiscard]] int definitionLineOf(std::string_view function, std::string_view source);

/// Line and column, from 1, of the first place outside comments and literals where a C++ source reads from
/// standard input by std::cin, stdin, scanf or getchar; 0, 0 when it does not.
[[nodiscard]] std::pair<int, int> standardInputUse(std::string_view source);

}  // namespace rex::grading
