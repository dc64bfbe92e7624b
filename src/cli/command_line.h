#pragma once

#include "cli/command_table.h"
#include "cli/project.h"

namespace rex::cli {

/// The main() of each program: runCommandLine(), ended cleanly by Ctrl-C and similar signals.
[[nodiscard]] int runProgram(int argc, const char* const* argv, const Project& project,
                             const CommandSet& set);

/// A whole program: parses the command line, runs the command, and explains errors. Returns the exit code.
/// Errors about unknown commands, options and names suggest the nearest ones. A command of another program is
/// handed over to its program. Throws Interrupted like runProcess().
[[nodiscard]] int runCommandLine(int argc, const char* const* argv, const Project& project,
                                 const CommandSet& set);

}  // namespace rex::cli
