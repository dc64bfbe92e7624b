#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "cli/json_internal.h"

namespace rex::cli {

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
