#include "reports/report.h"

#include <cstdlib>

#include <fmt/format.h>

namespace rex::reports {

std::string hundredthsText(std::int64_t value) {
  const std::string sign = value < 0 ? "-" : "";
  const std::int64_t size = std::abs(value);
  if (size % 100 == 0) return fmt::format("{}{}", sign, size / 100);
  std::string text = fmt::format("{}{}.{:02}", sign, size / 100, size % 100);
  if (text.ends_with('0')) text.pop_back();
  return text;
}

std::vector<std::string> judgementSentences(const Judgement& judgement) {
  std::vector<std::string> sentences = judgement.changes;
  if (!judgement.lateness.empty()) sentences.push_back(judgement.lateness);
  sentences.push_back(fmt::format("Final grade: {} of {} points.", hundredthsText(judgement.final),
                                  hundredthsText(judgement.possible)));
  return sentences;
}

std::span<const ReportFormat> reportFormats() {
  static constexpr ReportFormat kFormats[] = {{"github", "github.txt", githubReport},
                                              {"gradescope", "gradescope.json", gradescopeReport},
                                              {"junit", "junit.xml", junitReport},
                                              {"markdown", "summary.md", markdownReport}};
  return kFormats;
}

}  // namespace rex::reports
