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

/// How many hints of a part were shown before, and are shown now.
struct ShownHints {
  int before = 0;
  int now = 0;
  bool isKept = true;  ///< progress could be stored
};
/// Opens the next hint of a part, which counts; or none if it is to show them `again`.
ShownHints openHint(const Project& project, const ExerciseInfo& exercise, const grading::ExercisePart& part,
                    bool again = false);

ExitCode hint(const Project& project, const HintOptions& options);

}  // namespace rex::cli
