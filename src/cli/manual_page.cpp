#include "cli/manual_page.h"

#include <fmt/format.h>

#include "base/exit_code.h"
#include "cli/command_table.h"

namespace rex::cli {
namespace {

// A minus sign that may be copied, and no line that begins with a command of the language.
std::string plain(std::string_view text) {
  std::string written;
  for (const char c : text) {
    if (c == '\\' || c == '-') written += '\\';
    if ((c == '.' || c == '\'') && (written.empty() || written.back() == '\n')) written += "\\&";
    written += c;
  }
  return written;
}

}  // namespace

std::string manualPage() {
  std::string page = ".TH REX 1 \"\" \"rex " REX_VERSION
                     "\" \"User Commands\"\n"
                     ".SH NAME\n"
                     "rex \\- robotics exercises: see, solve and test them\n"
                     ".SH SYNOPSIS\n"
                     ".B rex\n"
                     ".RI [ COMMAND \" [\" ARGUMENTS ]]\n"
                     ".SH DESCRIPTION\n"
                     "Without a command, rex shows your points in all exercises and what to do next.\n"
                     "It works in a course folder, which\n"
                     ".B rex init\n"
                     "makes, and in all folders below it; commands about robots and methods work anywhere.\n"
                     ".B rex COMMAND \\-\\-help\n"
                     "explains the options of a command.\n"
                     ".SH COMMANDS\n";
  const char* topic = "";
  for (const TableEntry& entry : commandTable()) {
    if (std::string_view(topic) != nameOf(entry.topic))
      page += fmt::format(".SS {}\n", topic = nameOf(entry.topic));
    page += fmt::format(".TP\n.B {}\n{}.\n", plain(entry.name), plain(entry.purpose));
  }
  page += fmt::format(".SH EXIT STATUS\n{}\n", plain(kExitCodesHelp));
  page +=
      ".SH FILES\n"
      ".TP\n.I exercises/*/main.cpp\nWhat you complete and hand in.\n"
      ".TP\n.I out/\nPictures, films, replays and results. It may be deleted at any time.\n"
      ".TP\n.I .rex/course.json\nMarks a course folder and says what was handed out.\n"
      ".TP\n.I .rex/progress.json\nYour points.\n"
      ".SH ENVIRONMENT\n"
      ".TP\n.B NO_COLOR\nIf set, there are no colours.\n"
      ".TP\n.B TMPDIR\nThe folder for temporary files.\n"
      ".SH SEE ALSO\n"
      "The documents in\n.IR /usr/share/doc/rex ,\nabove all\n.IR student.md .\n";
  return page;
}

}  // namespace rex::cli
