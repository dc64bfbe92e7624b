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
ShownHints openHint(const Project& project, const ExerciseInfo& exercise,
                    const submission::ExercisePart& part, bool again = false);

ExitCode hint(const Project& project, const HintOptions& options);

/// Restores main.cpp as it was handed out, and keeps a copy of the current one.
ExitCode reset(const Project& project, const std::string& name);

struct ShowOptions {
  std::string exercise;
  bool solution = false;
};
/// Prints where replays, films, pictures and the result are, or the reference solution. Returns kBelow if
/// there are none, or the course does not show the solution yet.
ExitCode show(const Project& project, const ShowOptions& options);

}  // namespace rex::cli
