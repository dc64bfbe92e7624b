#include "reports/report.h"

namespace rex::grading {

std::span<const ReportFormat> reportFormats() {
  static constexpr ReportFormat kFormats[] = {{"exercism", "exercism.json", exercismReport},
                                              {"github", "github.txt", githubReport},
                                              {"gradescope", "gradescope.json", gradescopeReport},
                                              {"junit", "junit.xml", junitReport},
                                              {"markdown", "summary.md", markdownReport},
                                              {"prairielearn", "prairielearn.json", prairielearnReport}};
  return kFormats;
}

}  // namespace rex::grading
