#pragma once

#include <string>
#include <string_view>

#include "cli/command_line.h"
#include "cli/instructor/instructor_room.h"
#include "cli/methods/methods_room.h"
#include "cli/robot/robot_room.h"
#include "cli/student/student_room.h"

namespace rex::cli {

inline Room roomOf(Program program) {
  switch (program) {
    case Program::kStudent:
      return studentRoom();
    case Program::kRobot:
      return robotRoom();
    case Program::kMethods:
      return methodsRoom();
    case Program::kInstructor:
      return instructorRoom();
  }
  return {};
}

// The program that knows a command; for other words the one that users see.
inline Program programOf(std::string_view command) {
  for (const TableEntry& entry : commandTable())
    if (entry.name == command) return entry.program;
  return Program::kStudent;
}

// All programs of rex as one, for trees in which none is built.
inline int runRex(int argc, const char* const* argv, const Project& project) {
  const int command = argc > 2 && std::string_view(argv[1]) == "--complete" ? 2 : 1;
  return runCommandLine(argc, argv, project,
                        roomOf(argc > command ? programOf(argv[command]) : Program::kStudent));
}

}  // namespace rex::cli
