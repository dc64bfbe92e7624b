#pragma once

#include <string>

#include "reports/report.h"

namespace rex::cli {

/// The format of that name. Throws UsageError, which names the option and the nearest names.
[[nodiscard]] const grading::ReportFormat& reportFormat(const std::string& name, const std::string& option);

}  // namespace rex::cli
