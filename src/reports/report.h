#pragma once

#include <span>
#include <string>
#include <string_view>

#include "grading/results.h"

namespace rex::grading {

/// A result in the words of the programs around a course. The same result gives the same bytes, whatever
/// bytes its texts hold. Of hidden checks students see the points and the class of what happened, never a
/// message; their titles and properties go to Gradescope only, to be shown after the grades are published. A
/// fault of the grader is never written as a grade. Formats and fields: share/doc/report-formats.md.
[[nodiscard]] std::string gradescopeReport(const GradeResult& result);
[[nodiscard]] std::string prairielearnReport(const GradeResult& result);
[[nodiscard]] std::string exercismReport(const GradeResult& result);
[[nodiscard]] std::string junitReport(const GradeResult& result);
[[nodiscard]] std::string markdownReport(const GradeResult& result);
[[nodiscard]] std::string githubReport(const GradeResult& result);

struct ReportFormat {
  std::string_view name;
  std::string_view file;  ///< how it is called beside the result
  std::string (*write)(const GradeResult& result);
};

/// All of them, by name.
[[nodiscard]] std::span<const ReportFormat> reportFormats();

}  // namespace rex::grading
