#pragma once

#include <span>
#include <string_view>

namespace rex::cli {

/// A command of earlier versions, and the line that a user now types.
struct OldCommand {
  std::string_view name{}, now{};
};

/// They answer in this version; the next one may forget them.
[[nodiscard]] std::span<const OldCommand> oldCommands();

}  // namespace rex::cli
