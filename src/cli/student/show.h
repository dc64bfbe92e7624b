#pragma once

#include <string>

#include "base/exit_code.h"
#include "cli/project.h"

namespace rex::cli {

struct ShowOptions {
  std::string exercise;
  bool solution = false;
};
/// Prints where replays, films, pictures and the result are, or the reference solution. Returns kBelow if
/// there are none, or the course does not show the solution yet.
ExitCode show(const Project& project, const ShowOptions& options);

}  // namespace rex::cli
