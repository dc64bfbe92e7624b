#pragma once

#include <string>

#include <CLI/CLI.hpp>

#include "cli/command_table.h"

namespace rex::cli {

/// A command of a command, such as `rex dev new`, with examples at the end of its help.
CLI::App* addVerb(CLI::App* command, const std::string& name, const std::string& purpose,
                  const std::string& examples);

/// Prints a help text.
Action print(const std::string& text);

}  // namespace rex::cli
