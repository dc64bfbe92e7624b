#include "classroom/class_feedback.h"

#include <fmt/format.h>

#include "base/error.h"
#include "base/printable.h"
#include "base/text_file.h"
#include "classroom/hand_in.h"

namespace rex::grading {

namespace fs = std::filesystem;

namespace {

constexpr const char* kFeedbackPage = "feedback.html";

// Removes what an earlier export wrote, also an interrupted one. Other files are somebody's work.
void clearFeedback(const fs::path& folder) {
  if (!fs::exists(folder)) return;
  for (const auto& entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    if (name != "checks" && !name.starts_with(kFeedbackPage))
      throw Error({.what = "not replaced by feedback",
                   .where = {folder.string()},
                   .found = fmt::format("'{}', which no export wrote", printable(name, 100)),
                   .wanted = "another folder for feedback"});
  }
  fs::remove_all(folder);
}

}  // namespace

std::optional<Feedback> feedbackOf(const GradeRow& row, const fs::path& out) {
  if (!row.result) return {};
  Feedback feedback{.student = shownName(row.student),
                    .result = *row.result,
                    .judgement = judgementOf(row),
                    .source = readTextFile(out / row.handedInAs / row.exercise / "main.cpp")};
  for (const Comment& comment : row.comments)
    feedback.comments.push_back({comment.line, comment.text, comment.author});
  return feedback;
}

std::vector<FeedbackFile> evidenceOf(const GradeRow& row, const fs::path& out) {
  std::vector<FeedbackFile> files;
  if (!row.result) return files;
  const fs::path folder = out / row.handedInAs / row.exercise;
  for (const CheckResult& check : row.result->checks) {
    if (check.group == Group::kHidden) continue;
    for (const std::string& name : {check.picture, check.replay}) {
      const fs::path path(name);
      const bool isBeside = !name.empty() && path.is_relative() && path.lexically_normal() == path &&
                            *path.begin() != ".." && path.parent_path() == "checks";
      if (isBeside && fs::is_regular_file(fs::symlink_status(folder / path)))
        files.push_back({check.id, name, readTextFile(folder / path)});
    }
  }
  return files;
}

int writeFeedbackFolders(const Gradebook& book, const fs::path& results, const fs::path& out) {
  int written = 0;
  for (const GradeRow& row : book.rows) {
    if (const std::string why = whyNoStudentName(row.student.id); !why.empty())
      throw Error({.what = fmt::format("no folder for '{}'", row.student.id),
                   .found = why,
                   .wanted = "a plain name"});
    const fs::path folder = out / row.student.id / row.exercise;
    clearFeedback(folder);
    const auto feedback = feedbackOf(row, results);
    if (!feedback) continue;
    fs::create_directories(folder / "checks");
    const std::vector<FeedbackFile> files = evidenceOf(row, results);
    for (const FeedbackFile& file : files)
      if (!file.name.ends_with(".png")) replaceTextFile(folder / file.name, file.bytes, "a replay");
    if (fs::is_empty(folder / "checks")) fs::remove(folder / "checks");
    replaceTextFile(folder / kFeedbackPage, feedbackPage(*feedback, files), "the feedback");
    ++written;
  }
  return written;
}

}  // namespace rex::grading
