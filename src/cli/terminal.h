#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace rex::cli {

enum class Colour { kRed, kGreen, kYellow, kBold };

/// The text in that colour when standard output is a terminal that shows colours and NO_COLOR is unset or
/// empty, the plain text otherwise.
[[nodiscard]] std::string paint(Colour colour, std::string_view text);

/// Twenty characters that show a part of a whole: "####................". Neither empty nor full unless it
/// is.
[[nodiscard]] std::string bar(int part, int whole);

/// Breaks text at blanks so that lines have at most 80 columns, each but the first starting with `indent`
/// blanks. `used` columns of the first line are taken already.
[[nodiscard]] std::string wrap(std::string_view text, std::size_t indent, std::size_t used);

/// The text as printable() shows it, cut: for what a student's program or file says.
[[nodiscard]] std::string harmless(std::string_view text);

/// Prints a line on standard output, as terminalText().
void say(std::string_view line = "");

/// The same on standard error: what is going on, not what the user asked for.
void note(std::string_view line);

}  // namespace rex::cli
