#include "sandbox/report.h"

#include <sstream>

#include <fmt/format.h>

namespace rex::sandbox {

std::string errorLine(const std::string& message) { return "error " + message + "\n"; }

std::string endLine(const End& end) {
  return fmt::format("end {} {:.6f} {}\n", end.status, end.cpuSeconds, end.peakKilobytes);
}

Report readReport(const std::string& text) {
  Report report;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string kind;
    words >> kind;
    if (kind == "ready") report.ready = true;
    if (kind == "error") report.error = line.substr(6);
    End end;
    if (kind == "end" && words >> end.status >> end.cpuSeconds >> end.peakKilobytes) report.end = end;
  }
  return report;
}

}  // namespace rex::sandbox
