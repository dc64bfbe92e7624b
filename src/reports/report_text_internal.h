#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "grading/results.h"
#include "reports/report.h"

namespace rex::reports::internal {

/// Texts of a report are cut here, in bytes: readers of results have limits of about a megabyte.
inline constexpr std::size_t kLongestText = 50'000, kLongestMessage = 4'000;

/// For students, who get the reason from nobody else.
inline constexpr const char* kGraderFailed =
    "The grader itself failed: not your fault, and not your grade. Please tell those who run the course.";

/// printable() text of at most `limit` bytes; what is longer ends in " ...".
[[nodiscard]] std::string shownText(std::string_view text, std::size_t limit = kLongestMessage);

[[nodiscard]] bool isPassed(const grading::CheckResult& check);
[[nodiscard]] bool isHidden(const grading::CheckResult& check);

/// "pass", "time limit", "not run".
[[nodiscard]] std::string statusText(const grading::CheckResult& check);

/// What a student reads about a visible check that did not pass: message, line of `file`, and
/// input.
[[nodiscard]] std::string checkMessage(const grading::CheckResult& check, const std::string& file);

/// What the compiler said, a line for each message; or why the file was refused.
[[nodiscard]] std::string compileText(const grading::GradeResult& result);

/// The student's file, as it is called: "main.cpp".
[[nodiscard]] std::string submittedFile(const grading::GradeResult& result);

/// The same in the student's tree: "exercises/01-kinematics/main.cpp".
[[nodiscard]] std::string submittedPath(const grading::GradeResult& result);

/// "3 of 9 points".
[[nodiscard]] std::string pointsText(const grading::GradeResult& result);

/// In hundredths: those of a person count instead of those of the grading.
[[nodiscard]] std::int64_t pointsGiven(const grading::CheckResult& check, const Judgement* judgement);

/// "By part: step 2/4, motion 3/3."; empty for a single part.
[[nodiscard]] std::string pointsByPart(const grading::GradeResult& result,
                                       const Judgement* judgement = nullptr);

/// Seconds that visible checks took: how long a hidden one takes could tell its input.
[[nodiscard]] double visibleSeconds(const grading::GradeResult& result);

/// What the program printed in visible checks, both streams; empty if nothing.
[[nodiscard]] std::string printedText(const grading::GradeResult& result);

}  // namespace rex::reports::internal
