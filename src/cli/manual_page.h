#pragma once

#include <string>

namespace rex::cli {

/// The manual page rex(1) in the language of man: the table of commands, exit codes, files and variables.
[[nodiscard]] std::string manualPage();

}  // namespace rex::cli
