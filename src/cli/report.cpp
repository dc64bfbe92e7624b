#include "grading/report.h"

#include <algorithm>
#include <cstdio>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "base/error.h"
#include "cli/commands.h"
#include "cli/report_format.h"
#include "cli/terminal.h"
#include "grading/result_file.h"
#include "grading/text_file.h"

namespace rex::cli {

const grading::ReportFormat& reportFormat(const std::string& name, const std::string& option) {
  std::vector<std::string> known;
  for (const grading::ReportFormat& format : grading::reportFormats()) {
    if (format.name == name) return format;
    known.emplace_back(format.name);
  }
  throw UsageError({.what = option,
                    .found = harmless(name),
                    .wanted = fmt::format("one of {}", fmt::join(known, ", ")),
                    .nearest = nearestNames(name, known)});
}

ExitCode report(const ReportOptions& options) {
  const grading::ReportFormat& format = reportFormat(options.format, "--format");
  const grading::GradeResult result = grading::loadResult(options.results);
  const std::string text = format.write(result);
  if (options.out.empty())
    std::fputs(text.c_str(), stdout);
  else
    grading::replaceTextFile(options.out, text, "the report");
  return result.outcome == grading::Outcome::graderError ? ExitCode::kGraderFault : ExitCode::kFull;
}

}  // namespace rex::cli
