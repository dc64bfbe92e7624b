#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "grading/results.h"

namespace rex::reports {

/// What a course makes of a result: whose it is, what people changed, what lateness costs. Points in
/// hundredths. No part of it is in results.json.
struct Judgement {
  std::string student{};               ///< the name, for people
  std::vector<std::string> changes{};  ///< a sentence for each adjustment by a person
  std::string lateness{};              ///< a sentence; empty: in time
  std::int64_t penalty = 0;            ///< for lateness
  std::int64_t final = 0;
  std::int64_t possible = 0;
  std::map<std::string, std::int64_t> checks{};  ///< points that people gave, by the id of the check
};

/// "7.5": a number of hundredths, as short as possible.
[[nodiscard]] std::string hundredthsText(std::int64_t value);

/// The sentences of a judgement, the last of which gives the final points.
[[nodiscard]] std::vector<std::string> judgementSentences(const Judgement& judgement);

/// A result in the format of another program. The same result gives the same bytes, whatever bytes its
/// texts contain. For hidden checks students see the points and the kind of outcome, never a message. Their
/// titles and properties go only to Gradescope, to be shown after the grades are published. A grader error
/// is never written as a grade. A judgement is shown as such, and its final points are the points of the
/// whole; the checks keep theirs. Formats and fields: share/doc/platforms.md.
[[nodiscard]] std::string gradescopeReport(const grading::GradeResult& result,
                                           const Judgement* judgement = nullptr);
[[nodiscard]] std::string junitReport(const grading::GradeResult& result,
                                      const Judgement* judgement = nullptr);
[[nodiscard]] std::string markdownReport(const grading::GradeResult& result,
                                         const Judgement* judgement = nullptr);
[[nodiscard]] std::string githubReport(const grading::GradeResult& result,
                                       const Judgement* judgement = nullptr);

struct ReportFormat {
  std::string_view name;
  std::string_view file;  ///< its name next to the result
  std::string (*writer)(const grading::GradeResult& result, const Judgement* judgement);

  [[nodiscard]] std::string write(const grading::GradeResult& result,
                                  const Judgement* judgement = nullptr) const {
    return writer(result, judgement);
  }
};

/// All of them, by name.
[[nodiscard]] std::span<const ReportFormat> reportFormats();

}  // namespace rex::reports
