#include "classroom/csv.h"

#include "base/error.h"
#include "base/escape.h"

namespace rex::grading {

std::string csvLine(const std::vector<std::string>& fields) {
  std::string line;
  for (std::size_t k = 0; k < fields.size(); ++k) line += (k == 0 ? "" : ",") + csvField(fields[k]);
  return line + '\n';
}

std::vector<CsvRow> parseCsv(std::string_view text, const std::string& file, char separator) {
  if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);
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

}  // namespace rex::grading
