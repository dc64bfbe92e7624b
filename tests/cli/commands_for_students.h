#pragma once

#include <stdexcept>
#include <string_view>

#include "cli/command_table.h"

namespace rex::cli {

/// The program that knows a command; for other words the one that users see.
inline Program programOf(std::string_view command) {
  for (const TableEntry& entry : commandTable())
    if (entry.name == command) return entry.program;
  return Program::kStudent;
}

/// The programs that students get. The one for instructors needs modules that these tests do without: see
/// tests/commands.
inline CommandSet commandsForStudents(Program program) {
  switch (program) {
    case Program::kStudent:
      return studentCommands();
    case Program::kRobot:
      return robotCommands();
    case Program::kInstructor:
      break;
  }
  throw std::logic_error("tests of commands for instructors are in tests/commands");
}

}  // namespace rex::cli
