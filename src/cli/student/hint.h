#pragma once

#include <string>

#include "base/exit_code.h"
#include "cli/project.h"

namespace rex::cli {

struct HintOptions {
  std::string exercise;
  std::string part;    ///< empty: the first that needs one
  bool again = false;  ///< repeat the hints already shown
};
ExitCode hint(const Project& project, const HintOptions& options);

}  // namespace rex::cli
