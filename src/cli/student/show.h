#pragma once

#include <string>

#include "base/exit_code.h"
#include "cli/project.h"

namespace rex::cli {

struct ShowOptions {
  std::string exercise;
  bool solution = false;
};
/// Prints where replays, films, pictures and the result are. Returns kBelow if there are none.
ExitCode show(const Project& project, const ShowOptions& options);

}  // namespace rex::cli
