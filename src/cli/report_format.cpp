#include "cli/report_format.h"

#include <algorithm>
#include <vector>

#include <fmt/format.h>

#include "base/error.h"
#include "base/text.h"
#include "cli/terminal.h"

namespace rex::cli {

namespace {

const reports::ReportFormat& reportFormat(const std::string& name) {
  std::vector<std::string> known;
  for (const reports::ReportFormat& format : reports::reportFormats()) {
    if (format.name == name) return format;
    known.emplace_back(format.name);
  }
  throw UsageError({.what = "--report",
                    .found = escapeForTerminal(name),
                    .wanted = fmt::format("one of {}", join(known, ", ")),
                    .nearest = nearestNames(name, known)});
}

}  // namespace

std::vector<reports::ReportFormat> parseReportFormats(const std::string& names) {
  std::vector<reports::ReportFormat> formats;
  for (std::size_t at = 0; at < names.size();) {
    const std::size_t end = std::min(names.find(',', at), names.size());
    formats.push_back(reportFormat(names.substr(at, end - at)));
    at = end + 1;
  }
  return formats;
}

bool contains(const std::vector<reports::ReportFormat>& formats, const reports::ReportFormat& format) {
  return std::ranges::any_of(formats,
                             [&](const reports::ReportFormat& one) { return one.name == format.name; });
}

}  // namespace rex::cli
