#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace rex::grading {

/// One line of a CSV file (RFC 4180, but ending in LF). What a spreadsheet would take for a formula gets a '
/// in front (csvField()).
[[nodiscard]] std::string csvLine(const std::vector<std::string>& fields);

/// The rows of a CSV file, quoted or not; empty lines are left out, a mark of UTF-8 at the start, too. `file`
/// is for messages. Throws Error, with the line, for a quote that does not end.
struct CsvRow {
  int line = 0;
  std::vector<std::string> fields{};
};
[[nodiscard]] std::vector<CsvRow> parseCsv(std::string_view text, const std::string& file);

}  // namespace rex::grading
