#include "classroom/csv.h"

#include <algorithm>

#include <fmt/format.h>

#include "base/error.h"
#include "base/escape.h"
#include "base/text.h"
#include "base/text_file.h"
#include "classroom/gradebook_text.h"

namespace rex::classroom {
namespace {

// Quoted where needed, else as it was: Moodle compares what it reads back.
std::string unchangedField(const std::string& text) {
  if (text.find_first_of(",\"\r\n ;\t") == text.npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + '"';
}

}  // namespace

std::string csvLine(const std::vector<std::string>& fields) {
  std::string line;
  for (std::size_t k = 0; k < fields.size(); ++k) line += (k == 0 ? "" : ",") + csvField(fields[k]);
  return line + '\n';
}

std::vector<CsvRow> parseCsv(std::string_view text, const std::string& file, char separator) {
  text = withoutByteOrderMark(text);
  std::vector<CsvRow> rows;
  CsvRow row{.line = 1, .fields = {""}};
  bool isQuoted = false;
  int line = 1;
  const auto endRow = [&] {
    if (row.fields.size() > 1 || !row.fields.front().empty()) rows.push_back(row);
    row = {.line = line, .fields = {""}};
  };
  for (std::size_t k = 0; k < text.size(); ++k) {
    const char c = text[k];
    if (c == '\n') ++line;
    if (c == '"' && isQuoted && text.substr(k + 1).starts_with('"'))
      row.fields.back() += text[k++];
    else if (c == '"')
      isQuoted = !isQuoted;
    else if (isQuoted || (c != separator && c != '\n' && c != '\r'))
      row.fields.back() += c;
    else if (c == separator)
      row.fields.emplace_back();
    else if (c == '\n')
      endRow();
  }
  if (isQuoted)
    throw Error({.what = "a quote does not end", .where = {file, row.line, 0}, .wanted = "a CSV file"});
  endRow();
  return rows;
}

CsvTable::CsvTable(const std::filesystem::path& file, const std::string& what)
    : file_(file.string()), what_(what) {
  const std::string text = readTextFile(file);
  const auto refuse = [&](const char* found) {
    throw UsageError(
        {.what = "not " + what_, .where = {file_}, .found = found, .wanted = "a CSV file in UTF-8"});
  };
  if (!isUtf8(text) || text.find('\0') != text.npos) refuse("text in another encoding than UTF-8");
  hasMark_ = withoutByteOrderMark(text).size() < text.size();
  if (text.find("\r\n") != text.npos) lineEnd_ = "\r\n";
  const std::string first = text.substr(0, text.find('\n'));
  if (first.find(',') == first.npos && first.find(';') != first.npos) separator_ = ';';
  rows_ = parseCsv(text, file_, separator_);
  if (rows_.empty()) refuse("an empty file");
  headings_ = rows_.front();
  rows_.erase(rows_.begin());
}

std::size_t CsvTable::indexOf(const Headings& column) const {
  for (const std::string& heading : column)
    for (std::size_t k = 0; k < headings_.fields.size(); ++k)
      if (caseless(trimmed(headings_.fields[k])) == caseless(heading)) return k;
  return headings_.fields.size();
}

bool CsvTable::has(const Headings& column) const { return indexOf(column) < headings_.fields.size(); }

void CsvTable::require(const Headings& column) const {
  if (has(column)) return;
  throw UsageError({.what = "not " + what_,
                    .where = {file_, headings_.line, 0},
                    .found = printable(fmt::format("the columns {}", join(headings_.fields, ", ")), 400),
                    .wanted = fmt::format("a column '{}'", join(column, "' or '"))});
}

void CsvTable::refuseMisspelt(const std::vector<Headings>& columns) const {
  const auto isKnown = [&](const std::string& heading) {
    return std::ranges::any_of(columns, [&](const Headings& one) {
      return std::ranges::any_of(
          one, [&](const std::string& name) { return caseless(name) == caseless(heading); });
    });
  };
  for (const std::string& field : headings_.fields) {
    const std::string heading(trimmed(field));
    if (heading.empty() || isKnown(heading)) continue;
    for (const Headings& column : columns)
      if (const auto nearest = nearestNames(heading, column); !has(column) && !nearest.empty())
        throw UsageError({.what = fmt::format("column '{}' of {}", printable(heading), what_),
                          .where = {file_, headings_.line, 0},
                          .found = "an unknown heading",
                          .nearest = nearest});
  }
}

void CsvTable::requireWholeRow(std::size_t row) const {
  const std::size_t found = rows_.at(row).fields.size();
  if (found != headings_.fields.size())
    throw UsageError({.what = "not " + what_,
                      .where = {file_, rows_.at(row).line, 0},
                      .found = fmt::format("{} fields", found),
                      .wanted = fmt::format("{}", headings_.fields.size())});
}

void CsvTable::requireWholeRows() const {
  for (std::size_t row = 0; row < size(); ++row) requireWholeRow(row);
}

std::string CsvTable::text(std::size_t row, const Headings& column) const {
  const std::size_t index = indexOf(column);
  const std::vector<std::string>& fields = rows_.at(row).fields;
  return index < fields.size() ? std::string(trimmed(composed(fields[index]))) : "";
}

std::string CsvTable::place(std::size_t row) const { return fmt::format("{}:{}", file_, rows_.at(row).line); }

void CsvTable::set(std::size_t row, const Headings& column, const std::string& text) {
  rows_.at(row).fields.at(indexOf(column)) = text;
}

std::string CsvTable::csv() const {
  std::string all = hasMark_ ? "\xef\xbb\xbf" : "";
  const auto add = [&](const CsvRow& row) {
    for (std::size_t k = 0; k < row.fields.size(); ++k)
      all += (k == 0 ? "" : std::string(1, separator_)) + unchangedField(row.fields[k]);
    all += lineEnd_;
  };
  add(headings_);
  for (const CsvRow& row : rows_) add(row);
  return all;
}

}  // namespace rex::classroom
