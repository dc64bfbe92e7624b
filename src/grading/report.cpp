#include "grading/report.h"

namespace rex::grading {

std::span<const ReportFormat> reportFormats() {
  static constexpr ReportFormat kFormats[] = {
      {"exercism", exercismReport}, {"github", githubReport},     {"gradescope", gradescopeReport},
      {"junit", junitReport},       {"markdown", markdownReport}, {"prairielearn", prairielearnReport}};
  return kFormats;
}

}  // namespace rex::grading
