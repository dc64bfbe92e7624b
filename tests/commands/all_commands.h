#pragma once

#include <string_view>

#include "cli/command_line.h"
#include "cli/command_table.h"
#include "cli/commands_for_students.h"

namespace rex::cli {

inline CommandSet anyCommands(Program program) {
  return program == Program::kInstructor ? instructorCommands() : commandsForStudents(program);
}

// All programs of rex as one, for trees in which none is built.
inline int runRex(int argc, const char* const* argv, const Project& project) {
  return runCommandLine(argc, argv, project, anyCommands(programOf(argc > 1 ? argv[1] : "")));
}

}  // namespace rex::cli
