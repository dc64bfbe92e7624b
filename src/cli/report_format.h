#pragma once

#include <string>
#include <vector>

#include "reports/report.h"

namespace rex::cli {

/// The report formats with these comma-separated names, as `--report` takes them. Throws UsageError naming
/// the nearest.
[[nodiscard]] std::vector<reports::ReportFormat> parseReportFormats(const std::string& names);

/// Whether a format is among them.
[[nodiscard]] bool contains(const std::vector<reports::ReportFormat>& formats,
                            const reports::ReportFormat& format);

}  // namespace rex::cli
