#include "submission/demonstrations.h"

#include <algorithm>
#include <map>
#include <sstream>
#include <tuple>

#include <fmt/format.h>

#include "base/error.h"
#include "base/escape.h"
#include "base/text.h"
#include "base/text_file.h"

namespace rex::submission {
namespace {

namespace fs = std::filesystem;

constexpr const char *kHead = "Chapter", *kSlides = "Slides", *kFormula = "Formula", *kToTry = "Try";

// The lines of comment at the start, by the words that begin a paragraph. "Slides: 3:15" gives {"Slides",
// "3:15"}; the first paragraph is all of it, "Chapter 3: ...".
std::map<std::string, std::string> paragraphsOf(const std::string& text) {
  std::istringstream lines(text);
  std::map<std::string, std::string> all;
  std::string now = kHead;
  for (std::string line; std::getline(lines, line) && line.starts_with("// ");) {
    line = line.substr(3);
    for (const std::string name : {kSlides, kFormula, kToTry})
      if (line.starts_with(name + ": ")) now = name, line = line.substr(name.size() + 2);
    all[now] += (all[now].empty() ? "" : " ") + line;
  }
  return all;
}

Demonstration readDemonstration(const fs::path& file) {
  Demonstration found{.name = file.stem().string(), .file = file};
  const std::string text = readTextFile(file), start = std::string(kHead) + " ";
  found.takesSeed = text.find("argv[1]") != text.npos;
  found.takesRuns = text.find("argv[2]") != text.npos;
  std::map<std::string, std::string> said = paragraphsOf(text);
  const std::string head = said[kHead];
  const std::size_t colon = head.find(": "), stop = head.find(". ");
  if (head.starts_with(start) && colon != head.npos && stop != head.npos && colon < stop) {
    if (const auto chapter = parseNumber<int>(head.substr(start.size(), colon - start.size()))) {
      found.chapter = *chapter;
      found.title = head.substr(colon + 2, stop - colon - 2);
      found.about = head.substr(stop + 2);
      found.slides = said[kSlides], found.formula = said[kFormula], found.toTry = said[kToTry];
      return found;
    }
  }
  throw Error({.what = "the first comment of a demonstration",
               .where = {.file = file.string(), .line = 1},
               .found = "'" + head.substr(0, 60) + "'",
               .wanted = "'// Chapter 3: Title. What it shows.'"});
}

// A cell of a table in Markdown.
std::string cellText(std::string text) {
  for (std::size_t at = 0; (at = text.find('|', at)) != text.npos; at += 2) text.insert(at, "\\");
  return text;
}

}  // namespace

std::vector<Demonstration> demonstrations(const fs::path& folder) {
  std::vector<Demonstration> all;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder, ignored))
    if (entry.path().extension() == ".cpp") all.push_back(readDemonstration(entry.path()));
  std::ranges::sort(all, {}, [](const Demonstration& one) { return std::tie(one.chapter, one.name); });
  return all;
}

std::vector<std::pair<std::string, std::string>> demonstrationFacts(const Demonstration& one) {
  std::vector<std::pair<std::string, std::string>> facts{
      {"about", one.about}, {"try", one.toTry}, {"formula", one.formula}, {"slides", one.slides}};
  std::erase_if(facts, [](const auto& fact) { return fact.second.empty(); });
  return facts;
}

std::string demonstrationsPage(const std::vector<Demonstration>& all,
                               const std::function<std::string(const Demonstration&)>& linkTo) {
  std::string page = "# Demonstrations\n\n`rex demo NAME` opens one in a browser, with sliders.\n";
  int chapter = -1;
  for (const Demonstration& one : all) {
    if (one.chapter != chapter)
      page += fmt::format("\n## Chapter {}\n\n| name | shows | try | slides |\n| --- | --- | --- | --- |\n",
                          one.chapter);
    chapter = one.chapter;
    const std::string link = linkTo(one);
    page += fmt::format("| `{}` | {}{} | {} | {} |\n", one.name,
                        link.empty() ? "**" + one.title + "**" : fmt::format("[{}]({})", one.title, link),
                        one.formula.empty() ? "" : ": " + markdownText(one.formula), cellText(one.toTry),
                        one.slides);
  }
  return page;
}

}  // namespace rex::submission
