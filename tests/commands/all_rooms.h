#pragma once

#include <string_view>

#include "cli/command_line.h"
#include "cli/command_table.h"
#include "cli/rooms_of_students.h"

namespace rex::cli {

inline Room anyRoomOf(Program program) {
  return program == Program::kInstructor ? instructorRoom() : roomOfStudents(program);
}

// All programs of rex as one, for trees in which none is built.
inline int runRex(int argc, const char* const* argv, const Project& project) {
  return runCommandLine(argc, argv, project, anyRoomOf(programOf(argc > 1 ? argv[1] : "")));
}

}  // namespace rex::cli
