#pragma once

#include <optional>
#include <string>
#include <vector>

#include "grading/results.h"
#include "reports/report.h"

namespace rex::reports {

/// What a person writes about a line of main.cpp.
struct LineComment {
  int line = 0;  ///< 0: the whole file
  std::string text{};
  std::string author{};
};

/// What a student gets back for one exercise.
struct Feedback {
  std::string student{};  ///< the name
  grading::GradeResult result{};
  std::optional<Judgement> judgement{};
  std::string source{};  ///< main.cpp, as it was graded
  std::vector<LineComment> comments{};
};

/// A picture or replay of a visible check, by its path beside the page.
struct FeedbackFile {
  std::string check{};  ///< its id
  std::string name{};   ///< "checks/hand.png"
  std::string bytes{};
};

/// One HTML page that needs no network: grade, checks, pictures inside the page, links to replays beside it,
/// and main.cpp with the comments. Of hidden checks it shows only number, kind of outcome and points. All
/// texts are escaped, and no script may run.
[[nodiscard]] std::string feedbackPage(const Feedback& feedback, const std::vector<FeedbackFile>& files);

/// Parts of that page for other pages: the table of checks, or what the compiler says; and main.cpp with the
/// comments. If `path`, absolute, says where main.cpp is, lines lead to it in an editor.
/// A judgement changes points of checks.
[[nodiscard]] std::string checksHtml(const grading::GradeResult& result, const std::string& path = "",
                                     const Judgement* judgement = nullptr);
[[nodiscard]] std::string listingHtml(const Feedback& feedback, const std::string& path = "");

}  // namespace rex::reports
