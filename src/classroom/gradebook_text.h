#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "classroom/gradebook.h"
#include "reports/feedback_page.h"

namespace rex::classroom {

/// The text in Unicode's composed form (NFC), so that an umlaut is one character wherever it was typed. A
/// text that is not UTF-8 comes back as it is.
[[nodiscard]] std::string composed(std::string_view text);

/// composed() without differences of case and without joiners and other characters that programs may ignore,
/// to compare names and addresses.
[[nodiscard]] std::string caseless(std::string_view text);

[[nodiscard]] bool isUtf8(std::string_view text);

/// What the student of a row gets back; empty if nothing was graded. Reads main.cpp below `out`, the folder
/// of results. Throws Error if it cannot be read.
[[nodiscard]] std::optional<reports::Feedback> rowFeedback(const GradeRow& row,
                                                           const std::filesystem::path& out);

/// Pictures and replays of the visible checks of a row, from the folder that was graded for it. A name in
/// the result that leaves that folder is ignored.
[[nodiscard]] std::vector<reports::FeedbackFile> evidenceFiles(const GradeRow& row,
                                                               const std::filesystem::path& out);

/// Writes OUT/STUDENT/EXERCISE/feedback.html with its replays for each row that has a result, and removes
/// that of an earlier export for the others; returns the number of pages. Throws Error for a student whose
/// name cannot be that of a folder, and for a folder with files that no export wrote.
int writeFeedbackFolders(const Gradebook& book, const std::filesystem::path& results,
                         const std::filesystem::path& out);

/// The whole book for programs: schema rex-grades/1, share/grading/grades.schema.json.
[[nodiscard]] std::string gradesJson(const Gradebook& book, const Course& course);

}  // namespace rex::classroom
