#include "cli/student/watch_page.h"

#include <algorithm>
#include <cassert>
#include <vector>

#include <fmt/format.h>

#include "base/error.h"
#include "base/escape.h"
#include "base/text_file.h"
#include "grading/result_file.h"
#include "reports/feedback_page.h"

namespace rex::cli {
namespace {

namespace fs = std::filesystem;
using grading::CheckResult;
using grading::GradeResult;
using grading::Outcome;

bool passes(const CheckResult& check) { return check.status == Outcome::kPass; }

// Of visible checks only.
std::vector<std::string> newsOf(const GradeResult& result, const GradeResult& before) {
  std::vector<std::string> news;
  for (const CheckResult& check : result.checks) {
    if (check.group == grading::Group::kHidden) continue;
    const auto isSame = [&](const CheckResult& other) { return other.id == check.id; };
    const auto was = std::find_if(before.checks.begin(), before.checks.end(), isSame);
    if (was == before.checks.end() || passes(*was) == passes(check)) continue;
    news.push_back((passes(check) ? "Now passes: " : "Fails now: ") + check.title);
  }
  return news;
}

std::vector<grading::FeedbackFile> filesOf(const GradeResult& result, const fs::path& folder) {
  std::vector<grading::FeedbackFile> files;
  for (const CheckResult& check : result.checks)
    for (const std::string& name : {check.picture, check.replay})
      if (!name.empty() && fs::is_regular_file(folder / name))
        files.push_back({check.id, name, name.ends_with(".png") ? readTextFile(folder / name) : ""});
  return files;
}

void insertAfter(std::string& page, const std::string& where, const std::string& what) {
  const std::size_t at = page.find(where);
  assert(at != std::string::npos);
  page.insert(at + where.size(), what);
}

}  // namespace

std::string watchPage(const GradeResult& result, const std::optional<GradeResult>& before,
                      const std::string& source, const fs::path& folder) {
  std::string page = grading::feedbackPage({.result = result, .source = source}, filesOf(result, folder));
  insertAfter(page, "<head>\n", "<meta http-equiv=\"refresh\" content=\"2\">\n");
  if (!before) return page;
  std::string news;
  for (const std::string& line : newsOf(result, *before)) news += "<li>" + htmlText(line) + "</li>\n";
  insertAfter(page, "</h1>\n",
              news.empty() ? "<p>As after the last save.</p>\n" : "<ul>\n" + news + "</ul>\n");
  return page;
}

bool WatchPage::renew() {
  const fs::path results = folder_ / "results.json";
  if (!fs::exists(results)) return false;
  GradeResult now = grading::loadResult(results);
  const std::string source = fs::exists(main_) ? readTextFile(main_) : "";
  replaceTextFile(file(), watchPage(now, last_, source, folder_), "the page");
  last_ = std::move(now);
  return true;
}

}  // namespace rex::cli
