#include "classroom/class_feedback.h"

#include <fmt/format.h>

#include "base/error.h"
#include "base/text_file.h"
#include "classroom/hand_in.h"

namespace rex::grading {

namespace fs = std::filesystem;

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
    const auto feedback = feedbackOf(row, results);
    if (!feedback) continue;
    if (const std::string why = whyNoStudentName(row.student.id); !why.empty())
      throw Error({.what = fmt::format("no folder for '{}'", row.student.id),
                   .found = why,
                   .wanted = "a plain name"});
    const fs::path folder = out / row.student.id / row.exercise;
    fs::remove_all(folder);
    fs::create_directories(folder / "checks");
    const std::vector<FeedbackFile> files = evidenceOf(row, results);
    for (const FeedbackFile& file : files)
      if (!file.name.ends_with(".png")) replaceTextFile(folder / file.name, file.bytes, "a replay");
    if (fs::is_empty(folder / "checks")) fs::remove(folder / "checks");
    replaceTextFile(folder / "feedback.html", feedbackPage(*feedback, files), "the feedback");
    ++written;
  }
  return written;
}

}  // namespace rex::grading
