#pragma once
// Makes untrusted text harmless: printable characters, escaped for the medium that shows them.
#include <cstddef>
#include <set>
#include <string>
#include <string_view>

namespace rex {

/// Whether a character is invisible or changes the look of its neighbours: control and format characters
/// (Unicode's categories Cc and Cf), line and paragraph separators, characters that programs may ignore
/// (Default_Ignorable_Code_Point), and codes that are never characters. This includes newline and tab.
[[nodiscard]] bool isInvisible(char32_t character);

/// The single entry for untrusted text, before an escaper of base/escape.h: valid UTF-8 of at most `limit`
/// bytes, in which U+FFFD replaces every invalid byte and every isInvisible() character except newline, tab,
/// and what a script needs: a variation selector or a joiner (U+200C, U+200D) after a character of Arabic,
/// Indic and other such scripts, or after an emoji. Applying it twice changes nothing more.
[[nodiscard]] std::string printable(std::string_view text, std::size_t limit = std::string_view::npos);

/// The name of a person without the invisible characters that spreadsheets add (U+00AD, U+200B, U+200E,
/// U+200F, U+FEFF), without joiners and selectors where printable() would replace them, and without blanks
/// that these leave at its ends.
struct CleanName {
  std::string text{};
  std::set<std::string> lost{};  ///< what was left out: "U+200B"
};
[[nodiscard]] CleanName cleanName(std::string_view text);

/// Escapers of untrusted text, one for each medium, in which the result is nothing but text. All make the
/// text printable() first, so that it holds nothing invisible.

/// For elements and quoted attributes of XML 1.0; line breaks and tabs survive even in attributes.
[[nodiscard]] std::string xmlText(std::string_view text);

/// For elements and quoted attributes of HTML.
[[nodiscard]] std::string htmlText(std::string_view text);

/// For one line of Markdown, also in a table cell; line breaks and tabs become spaces.
[[nodiscard]] std::string markdownText(std::string_view text);

/// For the inside of <pre> in Markdown. No line of it acts as a command to a CI service that prints it.
[[nodiscard]] std::string markdownBlock(std::string_view text);

/// For one field of a CSV file (RFC 4180). A ' precedes each character that would begin a formula, also
/// where a spreadsheet splits at semicolons, tabs or line breaks, and for wide characters such as U+FF1D;
/// numbers are unchanged.
[[nodiscard]] std::string csvField(std::string_view text);

/// For the message of a GitHub workflow command: "::error::message".
[[nodiscard]] std::string commandMessage(std::string_view text);

/// For the value of a property of such a command: "::error title=value::".
[[nodiscard]] std::string commandProperty(std::string_view text);

/// JSON, as written by a library, with every isInvisible() character beyond ASCII as \uXXXX; values are kept.
[[nodiscard]] std::string visibleJson(std::string_view json);

/// For terminals: printable() except for the colours that `rex` itself uses (bold, red, green, yellow).
[[nodiscard]] std::string terminalText(std::string_view text);

}  // namespace rex
