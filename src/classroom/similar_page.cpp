#include <set>
#include <string_view>

#include <fmt/format.h>

#include "base/escape.h"
#include "base/join.h"
#include "base/lines.h"
#include "classroom/similar.h"

namespace rex::grading {
namespace {

constexpr std::string_view kStyle = R"(
body { font: 15px/1.5 sans-serif; margin: 2em auto; max-width: 110em; padding: 0 1em; color: #222; background: #fff; }
p { max-width: 50em; }
.pair { display: grid; grid-template-columns: 1fr 1fr; gap: 1em; }
pre { font: 12px/1.35 monospace; margin: 0; padding: .5em; border: 1px solid #ccc; overflow-x: auto; }
pre span { display: block; white-space: pre; min-height: 1.35em; }
.alike { background: #ffe9a8; }
.given { color: #999; }
)";

constexpr std::string_view kLimits =
    "<p>The programs were compared token by token, without comments, layout, names, numbers, and the lines "
    "of the "
    "file that was handed out. Marked lines are alike in both. There are honest reasons for that: a short "
    "task with one natural solution, a formula of the script, work in a group, the same tutorial. Code that "
    "was rewritten, taken from elsewhere or generated is not found at all. So this page decides "
    "nothing: look at the lines, and ask.</p>\n";

// Which of so many lines are in a run, by their numbers.
std::vector<bool> alikeLines(std::size_t count, const SimilarPair& pair,
                             std::pair<int, int> SimilarRun::*side) {
  std::vector<int> more(count + 2);  // runs that begin with a line, less those that ended before it
  for (const SimilarRun& run : pair.runs) {
    const auto [first, last] = run.*side;
    if (first < 1 || last < first || std::size_t(last) > count) continue;
    ++more[std::size_t(first)], --more[std::size_t(last) + 1];
  }
  std::vector<bool> alike(count + 1);
  int open = 0;
  for (std::size_t line = 1; line <= count; ++line) alike[line] = (open += more[line]) > 0;
  return alike;
}

// The lines of one side; `side` selects the lines of a run.
std::string column(const std::string& text, std::string_view handedOut, const SimilarPair& pair,
                   std::pair<int, int> SimilarRun::*side) {
  std::string html = "<pre>";
  const std::string own = withoutHandedOut(text, handedOut);
  const std::vector<std::string_view> ownLines = splitLines(own);
  const std::vector<bool> alike = alikeLines(ownLines.size(), pair, side);
  std::size_t line = 0;
  for (const std::string_view one : splitLines(text)) {
    const bool given = ownLines[line].empty();
    ++line;
    const char* kind = given ? " class=\"given\"" : alike[line] ? " class=\"alike\"" : "";
    html += fmt::format("<span{}>{:4}  {}</span>", kind, line, htmlText(one));
  }
  return html + "</pre>\n";
}

std::string textOf(const std::vector<ComparedText>& texts, const std::string& student) {
  for (const ComparedText& one : texts)
    if (one.student == student) return one.text;
  return "";
}

}  // namespace

std::string similarPage(const std::string& exercise, const std::vector<ComparedText>& texts,
                        std::string_view handedOut, const std::vector<SimilarPair>& pairs) {
  std::string html = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<title>{0}: similar "
      "submissions</title>\n<style>{1}</style>\n</head>\n<body>\n<h1>{0}: similar submissions</h1>\n{2}",
      htmlText(exercise), kStyle, kLimits);
  const auto groups = groupsOf(pairs);
  html += fmt::format("<p>{} submission{} compared, {} group{}, {} pair{}.</p>\n<ul>\n", texts.size(),
                      texts.size() == 1 ? "" : "s", groups.size(), groups.size() == 1 ? "" : "s",
                      pairs.size(), pairs.size() == 1 ? "" : "s");
  for (const std::vector<std::string>& group : groups)
    html += fmt::format("<li>{}</li>\n", htmlText(join(group, ", ")));
  html += "</ul>\n";
  for (const SimilarPair& pair : pairs) {
    html += fmt::format(
        "<h2>{0} and {1}</h2>\n<p>{2} % of {0} is also in {1}, {3} % of {1} is also in {0}.</p>\n",
        htmlText(pair.first), htmlText(pair.second), pair.firstPercent, pair.secondPercent);
    html += "<div class=\"pair\">\n" +
            column(textOf(texts, pair.first), handedOut, pair, &SimilarRun::first) +
            column(textOf(texts, pair.second), handedOut, pair, &SimilarRun::second) + "</div>\n";
  }
  return html + "</body>\n</html>\n";
}

}  // namespace rex::grading
