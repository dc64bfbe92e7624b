#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace rex::classroom {

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

/// A CSV file with headings in its first row, with commas or semicolons. A column is named by the headings
/// that it may have, ignoring case, such as those in the languages of a platform; the first that is there
/// counts.
class CsvTable {
 public:
  using Headings = std::vector<std::string>;

  /// Throws UsageError, which calls the table `what`, if it is not UTF-8 or has no headings; Error if it
  /// cannot be read.
  CsvTable(const std::filesystem::path& file, const std::string& what);

  [[nodiscard]] bool has(const Headings& column) const;
  /// Throws UsageError for a heading that is nearly one of these columns, if that column is missing.
  void refuseMisspelt(const std::vector<Headings>& columns) const;
  /// Throws UsageError with the headings that are there.
  void require(const Headings& column) const;
  /// Throws UsageError for a row with more or fewer fields than there are headings.
  void requireWholeRow(std::size_t row) const;
  void requireWholeRows() const;

  [[nodiscard]] std::size_t size() const { return rows_.size(); }
  /// In NFC and without blanks around it; empty without the column.
  [[nodiscard]] std::string text(std::size_t row, const Headings& column) const;
  /// "FILE:LINE".
  [[nodiscard]] std::string place(std::size_t row) const;

  /// Replaces a field of a column that is there.
  void set(std::size_t row, const Headings& column, const std::string& text);
  /// The file as it was read but for such fields: with its byte order mark, separators and line ends, and
  /// quotes where they are needed.
  [[nodiscard]] std::string csv() const;

 private:
  [[nodiscard]] std::size_t indexOf(const Headings& column) const;  ///< the number of columns: none

  std::string file_, what_;
  bool hasMark_ = false;
  char separator_ = ',';
  std::string lineEnd_ = "\n";
  CsvRow headings_{};
  std::vector<CsvRow> rows_{};
};

}  // namespace rex::classroom
