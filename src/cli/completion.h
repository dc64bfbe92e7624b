#pragma once

#include <span>
#include <string>
#include <vector>

#include "cli/project.h"

namespace CLI {
class App;  // of CLI11
}

namespace rex::cli {

/// What may stand in place of the last of these words, which begins it: a command, an option or a verb of the
/// command that the others reach, an exercise where the command takes one. Sorted; empty if a file is meant.
[[nodiscard]] std::vector<std::string> completions(const CLI::App& program,
                                                   std::span<const std::string> words,
                                                   const Project& project);

}  // namespace rex::cli
