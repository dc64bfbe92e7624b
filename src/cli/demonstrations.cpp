#include "cli/demonstrations.h"

#include <algorithm>
#include <sstream>
#include <tuple>

#include "base/error.h"
#include "base/text.h"
#include "base/text_file.h"

namespace rex::cli {
namespace {

namespace fs = std::filesystem;

// The lines of comment at the start, as one.
std::string firstComment(const std::string& text) {
  std::istringstream lines(text);
  std::string all;
  for (std::string line; std::getline(lines, line) && line.starts_with("// ");)
    all += (all.empty() ? "" : " ") + line.substr(3);
  return all;
}

Demonstration readDemonstration(const fs::path& file) {
  constexpr std::string_view kStart = "Chapter ";
  Demonstration found{.name = file.stem().string(), .file = file};
  const std::string text = readTextFile(file), comment = firstComment(text);
  found.takesSeed = text.find("argv[1]") != text.npos;
  found.takesRuns = text.find("argv[2]") != text.npos;
  const std::size_t colon = comment.find(": "), stop = comment.find(". ");
  if (comment.starts_with(kStart) && colon != comment.npos && stop != comment.npos && colon < stop) {
    if (const auto chapter = parseNumber<int>(comment.substr(kStart.size(), colon - kStart.size()))) {
      found.chapter = *chapter;
      found.title = comment.substr(colon + 2, stop - colon - 2);
      found.about = comment.substr(stop + 2);
      return found;
    }
  }
  throw Error({.what = "the first comment of a demonstration",
               .where = {.file = file.string(), .line = 1},
               .found = "'" + comment.substr(0, 60) + "'",
               .wanted = "'// Chapter 3: Title. What it shows.'"});
}

}  // namespace

std::vector<Demonstration> demonstrations(const Project& project) {
  std::vector<Demonstration> all;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(project.files() / "share" / "demonstrations", ignored))
    if (entry.path().extension() == ".cpp") all.push_back(readDemonstration(entry.path()));
  std::ranges::sort(all, {}, [](const Demonstration& one) { return std::tie(one.chapter, one.name); });
  return all;
}

}  // namespace rex::cli
