#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "sandbox/cell.h"
#include "submission/build_tools.h"
#include "submission/exercise_info.h"

namespace rex::authoring {

/// A question about a line of a person's own file, to which the grader knows the answer:
///   "Line 47: if `x + v` were `x - v`, which check would fail, and why?" "[step], as x is 1 m off."
struct VivaQuestion {
  std::string function{};         ///< that contains the line
  int line = 0;                   ///< in the file, from 1
  std::string before{}, after{};  ///< the line as it is and as it would be, with single blanks
  std::string check{}, title{};   ///< the first visible check that would fail
  std::string message{};          ///< what a student would read there
};

/// Up to `most` such questions, about different lines, and different functions as long as there are some.
/// Tried are changes of mutantsOfFile(), drawn by a fixed seed; one is asked about if a visible check that
/// the file passes then fails by wrong answers. The file is compiled and run in the sandbox, once for each
/// change, at most kMostTries times. Throws Error for a file that passes no visible check, and if the tools
/// fail.
[[nodiscard]] std::vector<VivaQuestion> vivaQuestions(const submission::Toolchain& toolchain,
                                                      const submission::ExerciseInfo& exercise,
                                                      const std::filesystem::path& file,
                                                      const sandbox::Sandbox& sandbox,
                                                      const std::filesystem::path& workFolder,
                                                      std::size_t most = 3);

inline constexpr int kMostTries = 12;

}  // namespace rex::authoring
