#pragma once

#include <span>
#include <string>
#include <string_view>

#include "grading/results.h"

namespace rex::grading {

/// A result in the format of another program. The same result gives the same bytes, whatever bytes its
/// texts contain. For hidden checks students see the points and the kind of outcome, never a message. Their
/// titles and properties go only to Gradescope, to be shown after the grades are published. A grader error
/// is never written as a grade. Formats and fields: share/doc/report-formats.md.
[[nodiscard]] std::string gradescopeReport(const GradeResult& result);
[[nodiscard]] std::string prairielearnReport(const GradeResult& result);
[[nodiscard]] std::string exercismReport(const GradeResult& result);
[[nodiscard]] std::string junitReport(const GradeResult& result);
[[nodiscard]] std::string markdownReport(const GradeResult& result);
[[nodiscard]] std::string githubReport(const GradeResult& result);

struct ReportFormat {
  std::string_view name;
  std::string_view file;  ///< its name next to the result
  std::string (*write)(const GradeResult& result);
};

/// All of them, by name.
[[nodiscard]] std::span<const ReportFormat> reportFormats();

}  // namespace rex::grading
