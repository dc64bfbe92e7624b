#pragma once

#include <optional>
#include <string>

namespace rex::sandbox {

/// What the launcher wrote into its report, a pipe that the program never holds.
struct Report {
  bool ready = false;           ///< the sandbox was set up; what followed is the program's doing
  std::string error{};          ///< why the sandbox could not be set up
  std::optional<int> status{};  ///< how the program ended, as from wait4(); only at levels 2 and 3
};

/// The lines of the report.
inline constexpr const char* kReady = "ready\n";
[[nodiscard]] std::string errorLine(const std::string& message);
[[nodiscard]] std::string endLine(int status);
[[nodiscard]] Report readReport(const std::string& text);

}  // namespace rex::sandbox
