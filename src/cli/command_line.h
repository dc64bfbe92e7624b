#pragma once

#include "cli/project.h"
#include "cli/room.h"

namespace rex::cli {

/// A whole program: reads the command line, does what it asks for, and explains what goes wrong. Returns the
/// exit code. Complaints about unknown commands, options and names tell the nearest ones. A command of
/// another room is handed over to its program. Throws Interrupted as runProcess() does.
[[nodiscard]] int runCommandLine(int argc, const char* const* argv, const Project& project, const Room& room);

}  // namespace rex::cli
