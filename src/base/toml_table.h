#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/error.h"

namespace rex {

/// One table of a TOML file, read key by key. Every method throws Error with the position of the key if the
/// value is missing or of another kind than the method reads.
class TomlTable {
 public:
  /// The top-level table of a file, called `name` in messages. Throws Error, with the position, for bad
  /// syntax and for a file that does not exist; `wanted` then says what it should be.
  static TomlTable read(const std::filesystem::path& file, std::string name, const std::string& wanted);

  void refuseKeysBut(const std::vector<std::string>& known) const;
  std::vector<std::string> keys() const;
  bool has(std::string_view key) const;
  SourceLocation where(std::string_view key) const;

  std::string text(std::string_view key) const;  ///< not empty
  bool boolean(std::string_view key) const;
  int integer(std::string_view key, int lowest, int highest) const;
  double number(std::string_view key, double above, double highest) const;
  std::vector<std::string> texts(std::string_view key) const;
  std::int64_t instant(std::string_view key) const;  ///< seconds since 1970 in UTC
  std::string day(std::string_view key) const;       ///< a date without a time: "2026-11-20"

  template <class Value>
  Value choice(std::string_view key, const std::vector<std::pair<std::string, Value>>& choices) const {
    std::vector<std::string> names;
    for (const auto& [name, value] : choices) names.push_back(name);
    return choices[indexOf(key, names)].second;
  }

  /// The table at a key, if there is one, under the given name. `wanted` is for the Error about other values.
  std::optional<TomlTable> table(std::string_view key, std::string name, const std::string& wanted) const;
  /// All tables headed [[key]].
  std::vector<TomlTable> tables(std::string_view key) const;

 private:
  struct Node;
  TomlTable(Node node, std::string name);
  std::size_t indexOf(std::string_view key, const std::vector<std::string>& names) const;

  std::shared_ptr<const Node> node_;  ///< keeps the whole file alive
  std::string name_;
};

}  // namespace rex
