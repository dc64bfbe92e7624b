#pragma once

#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "cli/project.h"

namespace rex::cli {

/// What does not build; the text ends with what the compiler said.
class BuildFailure : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Builds what is stale of these targets of the build folder, one build at a time, however many programs ask
/// for it. Speaks only when there is work, and then says how far it is. Does nothing where there is no build
/// to go on with: in an installed tree. Throws BuildFailure, and Interrupted.
void bringUpToDate(const Project& project, const std::vector<std::string>& targets, const std::string& what);

/// How far a build has come in so many seconds, by its log so far: "building rex: 37 %, about 50 s
/// left".
[[nodiscard]] std::string buildProgress(const std::string& what, std::string_view log, double seconds);

}  // namespace rex::cli
