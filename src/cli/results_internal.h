#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "cli/json_internal.h"

namespace rex::cli {

/// A table for people, each column as wide as its longest cell.
class Table {
 public:
  /// Of texts, two blanks apart.
  Table() = default;
  /// Of numbers, one blank apart and to the right, in columns of at least `numbers` characters. The first
  /// column has texts, and at least `first` characters.
  Table(std::size_t first, std::size_t numbers) : first_(first), numbers_(numbers) {}

  void add(std::vector<std::string> row) { rows_.push_back(std::move(row)); }
  void add(std::string name, const Eigen::Ref<const Eigen::VectorXd>& values, std::string (*format)(double));
  /// The lines, without blanks at their ends.
  [[nodiscard]] std::string text() const;

 private:
  std::size_t first_ = 0, numbers_ = 0;
  std::vector<std::vector<std::string>> rows_{};
};

/// What a command has found: lines for people, a JSON object for programs, and under its key "files" the
/// files that were written, which people see below the lines.
struct Results {
  std::vector<std::string> lines{};
  Json json = Json::object();

  /// Adds a line, formatted like fmt::format().
  template <class... Args>
  void line(fmt::format_string<Args...> format, Args&&... args) {
    lines.push_back(fmt::format(format, std::forward<Args>(args)...));
  }
  /// Adds a file as a user would type it, and returns its path for the function that writes it.
  std::filesystem::path file(const std::filesystem::path& path);
  /// Prints the JSON object or the text.
  void print(bool asJson) const;
};

}  // namespace rex::cli
