#pragma once

#include "cli/project.h"
#include "cli/room.h"

namespace rex::cli {

/// The main() of each program: runCommandLine(), ended cleanly by Ctrl-C and similar signals.
[[nodiscard]] int runProgram(int argc, const char* const* argv, const Project& project, const Room& room);

}  // namespace rex::cli
