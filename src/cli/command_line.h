#pragma once

#include "cli/project.h"
#include "cli/room.h"

namespace rex::cli {

/// A whole program: parses the command line, runs the command, and explains errors. Returns the exit code.
/// Errors about unknown commands, options and names suggest the nearest ones. A command of another room is
/// handed over to its program. Throws Interrupted like runProcess().
[[nodiscard]] int runCommandLine(int argc, const char* const* argv, const Project& project, const Room& room);

}  // namespace rex::cli
