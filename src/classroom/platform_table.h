#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "classroom/csv.h"

namespace rex::grading {

/// A table that a platform exports as CSV, with commas or semicolons.
class PlatformTable {
 public:
  /// Throws UsageError, which calls the table `what`, if it is not UTF-8 or has no headings; Error if it
  /// cannot be read.
  PlatformTable(const std::filesystem::path& file, const std::string& what);

  /// Which columns the table has, by headings in the languages of the platform, ignoring case.
  [[nodiscard]] bool has(const std::vector<std::string>& headings) const;
  /// Throws UsageError with the headings that are there.
  void require(const std::vector<std::string>& headings) const;

  [[nodiscard]] std::size_t size() const { return rows_.size(); }
  /// The text of the first of these columns, in NFC and without blanks around it; empty without the column.
  [[nodiscard]] std::string text(std::size_t row, const std::vector<std::string>& headings) const;
  /// "FILE:LINE".
  [[nodiscard]] std::string place(std::size_t row) const;

 private:
  std::size_t columnOf(const std::vector<std::string>& headings) const;  ///< the number of columns: none

  std::string file_, what_;
  std::vector<std::string> headings_{};
  std::vector<CsvRow> rows_{};
};

}  // namespace rex::grading
