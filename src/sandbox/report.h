#pragma once

#include <optional>
#include <string>

namespace rex::sandbox {

/// What the launcher wrote into its report, a pipe that the program never holds.
struct Report {
  bool ready = false;           ///< the sandbox stood; what came later is the program's doing
  std::string error{};          ///< why the sandbox does not stand
  std::optional<int> status{};  ///< how the program ended, as wait4() gives it; only levels 2 and 3 tell
};

/// The lines of the report.
inline constexpr const char* kReady = "ready\n";
[[nodiscard]] std::string errorLine(const std::string& message);
[[nodiscard]] std::string endLine(int status);
[[nodiscard]] Report readReport(const std::string& text);

}  // namespace rex::sandbox
