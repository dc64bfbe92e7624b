#pragma once

#include <span>
#include <string>
#include <string_view>

#include "grading/results.h"
#include "reports/judgement.h"

namespace rex::grading {

/// A result in the format of another program. The same result gives the same bytes, whatever bytes its
/// texts contain. For hidden checks students see the points and the kind of outcome, never a message. Their
/// titles and properties go only to Gradescope, to be shown after the grades are published. A grader error
/// is never written as a grade. A judgement is shown as such, and its final points are the points of the
/// whole; the checks keep theirs. Formats and fields: share/doc/report-formats.md.
[[nodiscard]] std::string gradescopeReport(const GradeResult& result, const Judgement* judgement = nullptr);
[[nodiscard]] std::string junitReport(const GradeResult& result, const Judgement* judgement = nullptr);
[[nodiscard]] std::string markdownReport(const GradeResult& result, const Judgement* judgement = nullptr);
[[nodiscard]] std::string githubReport(const GradeResult& result, const Judgement* judgement = nullptr);

struct ReportFormat {
  std::string_view name;
  std::string_view file;  ///< its name next to the result
  std::string (*writer)(const GradeResult& result, const Judgement* judgement);

  [[nodiscard]] std::string write(const GradeResult& result, const Judgement* judgement = nullptr) const {
    return writer(result, judgement);
  }
};

/// All of them, by name.
[[nodiscard]] std::span<const ReportFormat> reportFormats();

}  // namespace rex::grading
