#pragma once

#include "cli/project.h"

namespace rex::cli {

/// The whole program: reads the command line, does what it asks for, and explains what goes wrong. Returns
/// the exit code. Complaints about unknown commands, options and names tell the nearest ones. Throws
/// Interrupted as runProcess() does.
[[nodiscard]] int runCommandLine(int argc, const char* const* argv, const Project& project);

}  // namespace rex::cli
