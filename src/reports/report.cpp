#include "reports/report.h"

namespace rex::grading {

std::span<const ReportFormat> reportFormats() {
  static constexpr ReportFormat kFormats[] = {{"github", "github.txt", githubReport},
                                              {"gradescope", "gradescope.json", gradescopeReport},
                                              {"junit", "junit.xml", junitReport},
                                              {"markdown", "summary.md", markdownReport}};
  return kFormats;
}

}  // namespace rex::grading
