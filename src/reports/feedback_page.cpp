#include "reports/feedback_page.h"

#include <cctype>
#include <cstring>
#include <set>

#include <fmt/format.h>

#include "base/base64.h"
#include "base/escape.h"
#include "base/text.h"
#include "reports/report_text_internal.h"

namespace rex::reports {
namespace {

using namespace internal;

constexpr const char* kPageStart = R"(<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta http-equiv="Content-Security-Policy" content="default-src 'none'; img-src data:; style-src 'unsafe-inline'">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>{title}</title>
<style>
body {{ font: 16px/1.5 system-ui, sans-serif; color: #1d2530; max-width: 60rem; margin: 2rem auto; padding: 0 1rem; }}
table {{ border-collapse: collapse; }}
td, th {{ text-align: left; vertical-align: top; padding: .2rem .8rem .2rem 0; border-bottom: 1px solid #dde3e9; }}
.code td {{ border: 0; padding: 0 .8rem 0 0; font: 13px/1.5 monospace; white-space: pre-wrap; }}
.code td:first-child {{ color: #5c6875; text-align: right; }}
.note td {{ background: #fff6d6; font: inherit; padding: .2rem .8rem; }}
.passes td:first-child {{ color: #1b6e36; font-weight: 600; }}
.fails td:first-child {{ color: #b3261e; font-weight: 600; }}
img {{ max-width: 100%; border: 1px solid #dde3e9; }}
</style>
</head>
<body>
)";

std::string html(const std::string& text, std::size_t limit = kLongestMessage) {
  return htmlText(shownText(text, limit));
}

// "Hidden check 2", or title and id.
std::string nameOfCheck(const grading::CheckResult& check, int& hidden) {
  return isHidden(check) ? fmt::format("Hidden check {}", ++hidden)
                         : fmt::format("{} ({})", shownText(check.title), shownText(check.id));
}

// With the place, unless links lead there.
std::string foundBy(const grading::CheckResult& check, const grading::GradeResult& result,
                    const std::string& path = "") {
  if (isPassed(check) || isHidden(check) || !check.status) return "";
  grading::CheckResult placeless = check;
  if (!path.empty()) placeless.line = 0;
  return checkMessage(placeless, submittedFile(result));
}

// For addresses, in which everything but these characters is written as its bytes.
std::string addressOf(const std::string& path) {
  std::string text;
  for (const char c : path) {
    const bool isPlain =
        std::isalnum(static_cast<unsigned char>(c)) != 0 || std::strchr("/-._~", c) != nullptr;
    text += isPlain ? std::string(1, c) : fmt::format("%{:02X}", static_cast<unsigned char>(c));
  }
  return text;
}

std::string editorLink(const std::string& path, int line, const std::string& text) {
  return fmt::format("<a class=\"line\" href=\"vscode://file{}:{}\" title=\"Open in VS Code\">{}</a>",
                     addressOf(path), line, text);
}

// "main.cpp:47" as a link to the editor, and the whole path to copy; empty if there is no path or no line.
std::string placeOf(const std::string& path, const std::string& file, int line) {
  if (path.empty() || line <= 0) return "";
  return fmt::format(
      "<p class=\"place\">{} <button type=\"button\" data-copy=\"{}:{}\">Copy path</button></p>",
      editorLink(path, line, html(fmt::format("{}:{}", file, line))), htmlText(path), line);
}

// "3/4 instead of 1/4" if a person gave 3.
std::string pointsOf(const grading::CheckResult& check, const Judgement* judgement) {
  const std::string graded = fmt::format("{}/{}", check.points, check.maxPoints);
  const std::string given =
      fmt::format("{}/{}", hundredthsText(pointsGiven(check, judgement)), check.maxPoints);
  return given == graded ? graded : given + " instead of " + graded;
}

std::string tableOfChecks(const grading::GradeResult& result, const std::string& path,
                          const Judgement* judgement) {
  std::string text =
      "<table>\n<tr><th>Result</th><th>Check</th><th>Points</th><th>What was found</th></tr>\n";
  int hidden = 0;
  for (const grading::CheckResult& check : result.checks) {
    const bool isShown = !isPassed(check) && !isHidden(check);
    text += fmt::format("<tr class=\"{}\"><td>{}</td><td>{}</td><td>{}</td><td>{}{}</td></tr>\n",
                        isPassed(check) ? "passes" : "fails", html(statusText(check)),
                        html(nameOfCheck(check, hidden)), pointsOf(check, judgement),
                        html(foundBy(check, result, path)),
                        isShown ? placeOf(path, submittedFile(result), check.line) : "");
  }
  const std::string parts = pointsByPart(result, judgement);
  return text + "</table>\n" + (parts.empty() ? "" : "<p>" + html(parts) + "</p>\n");
}

// Where the compiler found something, one place for each line.
std::string compilerPlaces(const grading::GradeResult& result, const std::string& path) {
  std::string text;
  std::set<int> seen;
  for (const grading::CompileDiagnostic& message : result.compile.diagnostics)
    if (message.file == submittedFile(result) && message.severity != "note" &&
        seen.insert(message.line).second)
      text += placeOf(path, submittedFile(result), message.line);
  return text;
}

std::string evidence(const grading::GradeResult& result, const std::vector<FeedbackFile>& files) {
  std::string text;
  for (const grading::CheckResult& check : result.checks) {
    if (isHidden(check)) continue;
    for (const FeedbackFile& file : files) {
      if (file.check != check.id) continue;
      if (file.name.ends_with(".png"))
        text +=
            fmt::format("<h3>{}</h3>\n<p><img alt=\"What happened\" src=\"data:image/png;base64,{}\"></p>\n",
                        html(check.title), base64(file.bytes));
      else
        text += fmt::format("<p><a href=\"{}\">Replay: {}</a> (a file in the folder of this page)</p>\n",
                            html(file.name), html(check.title));
    }
  }
  return text.empty() ? "" : "<h2>Pictures</h2>\n" + text;
}

std::string author(const LineComment& comment) {
  return comment.author.empty() ? "" : fmt::format(" ({})", comment.author);
}

std::string noteOf(const LineComment& comment) {
  return fmt::format("<tr class=\"note\"><td></td><td dir=\"auto\">{}</td></tr>\n",
                     html(comment.text + author(comment)));
}

std::string gradeOf(const Feedback& feedback) {
  const grading::GradeResult& result = feedback.result;
  if (result.outcome == grading::Outcome::kGraderError) return kGraderFailed;
  return feedback.judgement ? fmt::format("{} of {} points", hundredthsText(feedback.judgement->final),
                                          hundredthsText(feedback.judgement->possible))
                            : pointsText(result);
}

}  // namespace

std::string checksHtml(const grading::GradeResult& result, const std::string& path,
                       const Judgement* judgement) {
  if (result.outcome == grading::Outcome::kGraderError) return "";
  if (result.outcome != grading::Outcome::kCompileError) return tableOfChecks(result, path, judgement);
  return fmt::format("<p>Cannot be graded:</p>\n<pre>{}</pre>\n", html(compileText(result), kLongestText)) +
         compilerPlaces(result, path);
}

std::string listingHtml(const Feedback& feedback, const std::string& path) {
  std::string text = "<h2>main.cpp</h2>\n<table class=\"code\">\n";
  for (const LineComment& comment : feedback.comments)
    if (comment.line == 0) text += noteOf(comment);
  const auto lines = splitLines(feedback.source);
  for (std::size_t k = 0; k < lines.size(); ++k) {
    const int line = static_cast<int>(k) + 1;
    const std::string number = std::to_string(line);
    text += fmt::format("<tr id=\"line{}\"><td>{}</td><td>{}</td></tr>\n", line,
                        path.empty() ? number : editorLink(path, line, number), htmlText(lines[k]));
    for (const LineComment& comment : feedback.comments)
      if (comment.line == line) text += noteOf(comment);
  }
  return text + "</table>\n";
}

std::string feedbackPage(const Feedback& feedback, const std::vector<FeedbackFile>& files) {
  const grading::GradeResult& result = feedback.result;
  const std::string title = fmt::format("{}: {}", result.exerciseId, gradeOf(feedback));
  std::string page = fmt::format(fmt::runtime(kPageStart), fmt::arg("title", html(title)));
  page += fmt::format("<h1>{}</h1>\n<p><bdi>{}</bdi></p>\n", html(title), html(feedback.student));
  if (feedback.judgement) {
    page += "<ul>\n";
    for (const std::string& sentence : judgementSentences(*feedback.judgement))
      page += fmt::format("<li><bdi>{}</bdi></li>\n", html(sentence));
    page += "</ul>\n";
  }
  page += checksHtml(result, "", feedback.judgement ? &*feedback.judgement : nullptr);
  const bool hasChecks =
      result.outcome != grading::Outcome::kCompileError && result.outcome != grading::Outcome::kGraderError;
  if (hasChecks) page += evidence(result, files);
  return page + listingHtml(feedback) + "</body>\n</html>\n";
}

}  // namespace rex::reports
