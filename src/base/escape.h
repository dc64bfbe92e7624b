#pragma once

#include <string>
#include <string_view>

namespace rex {

/// Text of strangers for one medium each: what comes out is nothing but text there. All make it printable()
/// first, so what it shows is what it holds.

/// For elements and quoted attributes of XML 1.0; also line breaks and tabs survive in attributes.
[[nodiscard]] std::string xmlText(std::string_view text);

/// For elements and quoted attributes of HTML.
[[nodiscard]] std::string htmlText(std::string_view text);

/// For one line of Markdown, also in a cell of a table; line breaks and tabs become blanks.
[[nodiscard]] std::string markdownText(std::string_view text);

/// For the inside of <pre> in Markdown. No line of it is a command to a CI service that prints it.
[[nodiscard]] std::string markdownBlock(std::string_view text);

/// For one field of a CSV file (RFC 4180). A ' goes before each sign that begins a formula, also where a
/// spreadsheet splits at semicolons, tabs or line breaks and where the sign is a wide one such as U+FF1D;
/// numbers stay.
[[nodiscard]] std::string csvField(std::string_view text);

/// For the message of a workflow command of GitHub: "::error::message".
[[nodiscard]] std::string commandMessage(std::string_view text);

/// For the value of a property of such a command: "::error title=value::".
[[nodiscard]] std::string commandProperty(std::string_view text);

/// JSON, as a library wrote it, with every isInvisible() character beyond ASCII as \uXXXX: the values stay.
[[nodiscard]] std::string visibleJson(std::string_view json);

/// For terminals: printable() but for the colours that `rex` itself uses (bold, red, green, yellow).
[[nodiscard]] std::string terminalText(std::string_view text);

}  // namespace rex
