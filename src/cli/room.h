#pragma once

#include <functional>
#include <map>
#include <string_view>

#include "base/exit_code.h"
#include "cli/command_table.h"
#include "cli/project.h"

namespace CLI {
class App;  // of CLI11
}

namespace rex::cli {

/// What the command line requests, ready to be run.
using Action = std::function<ExitCode(const Project&)>;

/// Adds options and examples to a command; `action` is set if the user calls it. Both outlive the parsing.
using Registration = void (*)(CLI::App* command, Action& action);

/// What one program does itself: the commands that the table assigns to it.
struct Room {
  Program program{};
  std::map<std::string_view, Registration> commands{};
  Action withoutCommand{};  ///< empty: `rex` handles it
};

}  // namespace rex::cli
