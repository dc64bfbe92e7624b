#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "cli/project.h"

namespace rex::cli {

/// A program of share/demonstrations. Its first comment says what it shows: "// Chapter 3: PID control. The
/// rest may take several lines."
struct Demonstration {
  std::string name{};   ///< of its file, without .cpp
  int chapter = 0;      ///< of the course script
  std::string title{};  ///< "PID control"
  std::string about{};  ///< "The rest may take several lines."
  std::filesystem::path file{};
  /// Whether its random numbers have a seed, argv[1], and it counts runs with one seed after the other,
  /// argv[2].
  bool takesSeed = false, takesRuns = false;
};

/// All of them, by chapter and name. Throws Error with file:line for a first comment that is not of this
/// form.
[[nodiscard]] std::vector<Demonstration> demonstrations(const Project& project);

}  // namespace rex::cli
