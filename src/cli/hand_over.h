#pragma once

#include <string>
#include <vector>

#include "cli/command_table.h"
#include "cli/project.h"

namespace rex::cli {

/// Builds that program of rex where it is stale, and becomes it, with the same words after its name. Throws
/// as bringUpToDate(), and Error if there is no such program.
[[noreturn]] void becomeProgram(const Project& project, Program program, std::vector<std::string> words);

}  // namespace rex::cli
