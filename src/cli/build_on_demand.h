#pragma once

#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "cli/project.h"

namespace rex::cli {

/// A failed build; the text ends with the compiler's messages.
class BuildFailure : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Builds those of these targets that are out of date, one build at a time, however many programs ask for
/// it. If there is work to do, it prints its progress. Does nothing in an installed tree, which has no
/// build folder. Throws BuildFailure and Interrupted.
void bringUpToDate(const Project& project, const std::vector<std::string>& targets, const std::string& what);

/// The progress of a build after so many seconds, from its log so far: "building rex: 37 %, about 50 s
/// left".
[[nodiscard]] std::string buildProgress(const std::string& what, std::string_view log, double seconds);

}  // namespace rex::cli
