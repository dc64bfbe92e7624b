#include <sstream>

#include <fmt/format.h>

#include "base/error.h"
#include "base/printable.h"
#include "base/text_file.h"
#include "classroom/gradebook.h"

namespace rex::grading {
namespace {

constexpr const char* kNotTakenHeadings = "student\texercise\twhy";

std::string oneCell(const std::string& text) {
  std::string cell = printable(text);
  for (char& c : cell)
    if (c == '\t' || c == '\n') c = ' ';
  return cell;
}

}  // namespace

std::string notTakenText(const std::vector<NotTaken>& all) {
  std::string text = fmt::format("{}\n", kNotTakenHeadings);
  for (const NotTaken& one : all)
    text += fmt::format("{}\t{}\t{}\n", oneCell(one.student), one.exercise, oneCell(one.why));
  return text;
}

std::vector<NotTaken> readNotTaken(const std::filesystem::path& file) {
  std::vector<NotTaken> all;
  if (!std::filesystem::exists(file)) return all;
  std::istringstream lines(readTextFile(file));
  std::string line;
  for (int number = 1; std::getline(lines, line); ++number) {
    const std::size_t first = line.find('\t'), second = line.find('\t', first + 1);
    if (first == std::string::npos || second == std::string::npos ||
        (number == 1 && line != kNotTakenHeadings))
      throw Error({.what = "not a list of what was not taken",
                   .where = {file.string(), number, 0},
                   .wanted = "student, exercise and reason, as `rex grade` writes them"});
    if (number > 1)
      all.push_back(
          {line.substr(0, first), line.substr(first + 1, second - first - 1), line.substr(second + 1)});
  }
  return all;
}

}  // namespace rex::grading
