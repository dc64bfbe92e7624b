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

/// What the command line asks for, ready to be done.
using Action = std::function<ExitCode(const Project&)>;

/// Gives a command its options and examples; `action` is set when the user asks for it. Both outlive the
/// parsing.
using Registration = void (*)(CLI::App* command, Action& action);

/// What one of the programs does itself: the commands that the table gives it.
struct Room {
  Program program{};
  std::map<std::string_view, Registration> commands{};
  Action withoutCommand{};  ///< nothing: `rex` knows
};

}  // namespace rex::cli
