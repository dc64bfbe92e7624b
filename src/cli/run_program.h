#pragma once

#include "cli/project.h"
#include "cli/room.h"

namespace rex::cli {

/// What main() of each program does: runCommandLine(), which Ctrl-C and its like end tidily.
[[nodiscard]] int runProgram(int argc, const char* const* argv, const Project& project, const Room& room);

}  // namespace rex::cli
