#include "sandbox/report.h"

#include <sstream>

#include <fmt/format.h>

namespace rex::sandbox {

std::string errorLine(const std::string& message) { return "error " + message + "\n"; }

std::string endLine(int status) { return fmt::format("end {}\n", status); }

Report readReport(const std::string& text) {
  Report report;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string kind;
    words >> kind;
    if (kind == "ready") report.ready = true;
    if (kind == "error") report.error = line.substr(6);
    int status = 0;
    if (kind == "end" && words >> status) report.status = status;
  }
  return report;
}

}  // namespace rex::sandbox
