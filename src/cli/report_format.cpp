#include "cli/report_format.h"

#include <vector>

#include <fmt/format.h>

#include "base/error.h"
#include "base/join.h"
#include "cli/terminal.h"

namespace rex::cli {

const grading::ReportFormat& reportFormat(const std::string& name, const std::string& option) {
  std::vector<std::string> known;
  for (const grading::ReportFormat& format : grading::reportFormats()) {
    if (format.name == name) return format;
    known.emplace_back(format.name);
  }
  throw UsageError({.what = option,
                    .found = harmless(name),
                    .wanted = fmt::format("one of {}", join(known, ", ")),
                    .nearest = nearestNames(name, known)});
}

}  // namespace rex::cli
