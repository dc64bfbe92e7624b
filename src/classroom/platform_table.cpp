#include "classroom/platform_table.h"

#include <algorithm>

#include <fmt/format.h>

#include "base/error.h"
#include "base/join.h"
#include "base/printable.h"
#include "base/text_file.h"
#include "classroom/composed_text.h"

namespace rex::grading {
namespace {

std::string trimmed(const std::string& text) {
  constexpr const char* kBlanks = " \t\r\n";
  const std::size_t first = text.find_first_not_of(kBlanks);
  return first == text.npos ? "" : text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}

}  // namespace

PlatformTable::PlatformTable(const std::filesystem::path& file, const std::string& what)
    : file_(file.string()), what_(what) {
  const std::string text = readTextFile(file);
  const auto refuse = [&](const char* found) {
    throw UsageError(
        {.what = "not " + what_, .where = {file_}, .found = found, .wanted = "a CSV file in UTF-8"});
  };
  if (!isUtf8(text) || text.find('\0') != text.npos) refuse("text in another encoding than UTF-8");
  const std::string headings = text.substr(0, text.find('\n'));
  const bool hasSemicolons = headings.find(',') == headings.npos && headings.find(';') != headings.npos;
  rows_ = parseCsv(text, file_, hasSemicolons ? ';' : ',');
  if (rows_.empty()) refuse("an empty file");
  for (const std::string& heading : rows_.front().fields) headings_.push_back(trimmed(composed(heading)));
  rows_.erase(rows_.begin());
}

std::size_t PlatformTable::columnOf(const std::vector<std::string>& headings) const {
  for (const std::string& heading : headings)
    for (std::size_t k = 0; k < headings_.size(); ++k)
      if (caseless(headings_[k]) == caseless(heading)) return k;
  return headings_.size();
}

bool PlatformTable::has(const std::vector<std::string>& headings) const {
  return columnOf(headings) < headings_.size();
}

void PlatformTable::require(const std::vector<std::string>& headings) const {
  if (has(headings)) return;
  throw UsageError({.what = "not " + what_,
                    .where = {file_, 1, 0},
                    .found = printable(fmt::format("the columns {}", join(headings_, ", ")), 400),
                    .wanted = fmt::format("a column '{}'", join(headings, "' or '"))});
}

std::string PlatformTable::text(std::size_t row, const std::vector<std::string>& headings) const {
  const std::size_t column = columnOf(headings);
  const std::vector<std::string>& fields = rows_.at(row).fields;
  return column < fields.size() ? trimmed(composed(fields[column])) : "";
}

std::string PlatformTable::place(std::size_t row) const {
  return fmt::format("{}:{}", file_, rows_.at(row).line);
}

}  // namespace rex::grading
