#include "cli/numbers.h"

#include <algorithm>
#include <cctype>
#include <fstream>
#include <iterator>
#include <system_error>

#include <fmt/format.h>

#include "base/error.h"
#include "base/text.h"
#include "cli/terminal.h"

namespace rex::cli {
namespace {

// "nan" and the like begin with a letter, too, but are numbers.
bool isLineOfNames(std::string_view line) {
  const bool isName = line[0] == '"' || line[0] == '\'' || std::isalpha(static_cast<unsigned char>(line[0]));
  return isName && !isNumeral(line.substr(0, line.find_first_of(", \t\r;")));
}

std::vector<NumberTable::Name> namesIn(std::string_view line) {
  std::vector<NumberTable::Name> names;
  for (const std::string_view field : splitAt(line, ',')) {
    std::string_view name = trimmed(field);
    const int column = columnIn(line, name);
    if (name.size() > 1 && name.front() == '"' && name.back() == '"') name = name.substr(1, name.size() - 2);
    names.push_back({std::string(name), column});
  }
  return names;
}

}  // namespace

Refusal optionRefusal(const std::string& option) {
  return [option](const std::string& found, const std::string& wanted) {
    throw UsageError({.what = option, .found = found, .wanted = wanted});
  };
}

std::vector<std::string_view> numberWords(std::string_view text, const Refusal& refuse) {
  if (text.find(';') != text.npos) refuse("';'", "commas or blanks between numbers");
  std::vector<std::string_view> words = splitList(text);
  const auto isEmpty = [](std::string_view word) { return word.empty(); };
  if (std::ranges::any_of(words, isEmpty)) refuse("an empty field", "a number between commas");
  return words;
}

Eigen::Vector3d parsePoint(const std::string& text, const std::string& option, const std::string& form) {
  const Refusal refuse = optionRefusal(option);
  const std::vector<std::string_view> words = numberWords(text, refuse);
  if (words.size() != 3) refuse(fmt::format("{} numbers", words.size()), "three: " + form);
  Eigen::Vector3d point;
  for (int i = 0; i < 3; ++i) {
    const std::string_view word = words[static_cast<std::size_t>(i)];
    const std::optional<double> number = parseNumber<double>(word);
    if (!number) refuse(fmt::format("'{}'", word), "a number");
    point[i] = *number;
  }
  return point;
}

NumberTable readNumberTable(const std::filesystem::path& file, const std::string& what) {
  std::ifstream input(file);
  std::error_code ignored;
  if (!input || std::filesystem::is_directory(file, ignored))
    throw UsageError({.what = "cannot read the " + what, .where = {file.string()}});
  const std::string text(std::istreambuf_iterator<char>(input), {});
  NumberTable table{.file = file.string()};
  SourceLocation where{table.file};
  const auto refuse = [&](const std::string& found, const std::string& wanted) {
    throw UsageError({.what = what, .where = where, .found = found, .wanted = wanted});
  };
  for (const std::string_view line : splitLines(text)) {
    ++where.line;
    const std::string_view content = trimmed(where.line == 1 ? withoutByteOrderMark(line) : line);
    where.column = columnIn(line, content);
    if (content.empty() || content[0] == '#') continue;
    if (table.rows.empty() && isLineOfNames(content)) {
      table.namesLine = where.line;
      table.names = namesIn(content);
      for (NumberTable::Name& name : table.names) name.column += where.column - 1;
      continue;
    }
    NumberTable::Row row{where.line, where.column, {}};
    for (const std::string_view word : numberWords(content, refuse)) {
      where.column = columnIn(line, word);
      const std::optional<double> number = parseNumber<double>(word);
      if (!number) refuse("'" + escapeForTerminal(word) + "'", "a number");
      row.values.push_back(*number);
    }
    where.column = row.column;
    if (!table.rows.empty() && row.values.size() != table.rows[0].values.size())
      refuse(fmt::format("{} number{}", row.values.size(), row.values.size() == 1 ? "" : "s"),
             fmt::format("{} as in line {}", table.rows[0].values.size(), table.rows[0].line));
    table.rows.push_back(std::move(row));
  }
  return table;
}

}  // namespace rex::cli
