#pragma once

#include <optional>
#include <string>

namespace rex::sandbox {

/// How a confined program ended, as the launcher of levels 2 and 3 saw it.
struct End {
  int status = 0;         ///< as wait4() gives it
  double cpuSeconds = 0;  ///< of all its processes
  long peakKilobytes = 0;
};

/// What the launcher wrote into its report, a pipe that the program never holds.
struct Report {
  bool ready = false;   ///< the sandbox stood; what came later is the program's doing
  std::string error{};  ///< why the sandbox does not stand
  std::optional<End> end{};
};

/// The lines of the report.
inline constexpr const char* kReady = "ready\n";
[[nodiscard]] std::string errorLine(const std::string& message);
[[nodiscard]] std::string endLine(const End& end);
[[nodiscard]] Report readReport(const std::string& text);

}  // namespace rex::sandbox
