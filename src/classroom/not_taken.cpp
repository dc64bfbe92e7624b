#include <fmt/format.h>

#include "base/error.h"
#include "base/lines.h"
#include "base/printable.h"
#include "base/text.h"
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
  const std::string text = readTextFile(file);
  int number = 0;
  for (const std::string_view line : splitLines(text)) {
    const std::vector<std::string_view> cells = splitAt(line, '\t');
    if (++number == 1 ? line != kNotTakenHeadings : cells.size() != 3)
      throw Error({.what = "not a list of what was not taken",
                   .where = {file.string(), number, 0},
                   .wanted = "student, exercise and reason, as `rex grade` writes them"});
    if (number > 1) all.push_back({std::string(cells[0]), std::string(cells[1]), std::string(cells[2])});
  }
  return all;
}

}  // namespace rex::grading
