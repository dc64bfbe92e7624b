#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace rex::grading {

/// One line of a CSV file (RFC 4180, but ending in LF). Fields that a spreadsheet would take for a formula
/// are prefixed with ' (csvField()).
[[nodiscard]] std::string csvLine(const std::vector<std::string>& fields);

/// The rows of a CSV file, quoted or not. Empty lines and a UTF-8 byte order mark are skipped. `file` is
/// for messages. Fields are separated by commas unless `separator` says otherwise. Throws Error with the line
/// for an unterminated quote.
struct CsvRow {
  int line = 0;
  std::vector<std::string> fields{};
};
[[nodiscard]] std::vector<CsvRow> parseCsv(std::string_view text, const std::string& file,
                                           char separator = ',');

}  // namespace rex::grading
