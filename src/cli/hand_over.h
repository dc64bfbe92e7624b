#pragma once

#include <string>
#include <vector>

#include "cli/command_table.h"
#include "cli/project.h"

namespace rex::cli {

/// Builds that program of rex if it is out of date, and executes it in place of this one, with the same
/// arguments. Throws like bringUpToDate(), and Error if there is no such program.
[[noreturn]] void becomeProgram(const Project& project, Program program, std::vector<std::string> words);

}  // namespace rex::cli
