#pragma once

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <toml++/toml.h>

#include "base/error.h"
#include "grading/instant.h"

namespace rex::grading::internal {

/// One table of a TOML file, read key by key; every complaint knows its place.
class TableReader {
 public:
  TableReader(const toml::table& table, std::string name, std::string file)
      : table_(table), name_(std::move(name)), file_(std::move(file)) {}

  void refuseKeysBut(const std::vector<std::string>& known) const {
    for (const auto& [key, node] : table_) {
      const std::string found(key.str());
      if (std::find(known.begin(), known.end(), found) != known.end()) continue;
      throw Error({.what = fmt::format("unknown key '{}' in {}", found, name_),
                   .where = at(key.source()),
                   .wanted = fmt::format("one of {}", fmt::join(known, ", ")),
                   .nearest = nearestNames(found, known)});
    }
  }

  std::string text(std::string_view key) const {
    const auto value = require(key, "a string").value_exact<std::string>();
    if (!value || value->empty()) complain(key, "a string that is not empty");
    return *value;
  }

  int integer(std::string_view key, int lowest, int highest) const {
    const std::string wanted = fmt::format("a whole number from {} to {}", lowest, highest);
    const auto value = require(key, wanted).value_exact<std::int64_t>();
    if (!value || *value < lowest || *value > highest) complain(key, wanted);
    return static_cast<int>(*value);
  }

  double number(std::string_view key, double above, double highest) const {
    const std::string wanted = fmt::format("a number above {} and at most {}", above, highest);
    const toml::node& node = require(key, wanted);
    const auto value = node.is_number() ? node.value<double>() : std::nullopt;
    if (!value || !(*value > above) || *value > highest) complain(key, wanted);
    return *value;
  }

  std::vector<std::string> texts(std::string_view key) const {
    std::vector<std::string> list;
    const toml::array* array = require(key, "a list of strings").as_array();
    if (!array) complain(key, "a list of strings");
    for (const toml::node& node : *array) {
      if (!node.is_string()) complain(key, "a list of strings");
      list.push_back(node.as_string()->get());
    }
    return list;
  }

  template <class Value>
  Value choice(std::string_view key, const std::vector<std::pair<std::string, Value>>& choices) const {
    std::vector<std::string> names;
    for (const auto& [name, value] : choices) names.push_back(name);
    const std::string wanted = fmt::format("one of {}", fmt::join(names, ", "));
    const auto text = require(key, wanted).template value_exact<std::string>();
    for (const auto& [name, value] : choices)
      if (text && *text == name) return value;
    complain(key, wanted);
  }

  /// Seconds since 1970 in UTC.
  std::int64_t instant(std::string_view key) const {
    const std::string wanted = "a time with its zone, such as 2026-11-20T23:59:00+01:00";
    const auto value = require(key, wanted).template value_exact<toml::date_time>();
    std::ostringstream text;
    if (value) text << *value;
    const auto seconds = parseInstant(text.str().substr(0, text.str().find('.')));
    if (!value || !value->offset || !seconds) complain(key, wanted);
    return *seconds;
  }

  bool has(std::string_view key) const { return table_.contains(key); }

  SourceLocation where(std::string_view key) const {
    const toml::node* node = table_.get(key);
    return at(node ? node->source() : table_.source());
  }

  SourceLocation at(const toml::source_region& region) const {
    return {file_, static_cast<int>(region.begin.line), static_cast<int>(region.begin.column)};
  }

 private:
  const toml::node& require(std::string_view key, const std::string& wanted) const {
    if (const toml::node* node = table_.get(key)) return *node;
    throw Error(
        {.what = fmt::format("{}: no '{}'", name_, key), .where = at(table_.source()), .wanted = wanted});
  }

  [[noreturn]] void complain(std::string_view key, const std::string& wanted) const {
    const toml::node& node = *table_.get(key);
    std::ostringstream found;
    node.visit([&](const auto& value) { found << value; });
    throw Error({.what = fmt::format("{}: '{}'", name_, key),
                 .where = at(node.source()),
                 .found = found.str(),
                 .wanted = wanted});
  }

  const toml::table& table_;
  std::string name_;
  std::string file_;
};

/// The tables of a file. Throws Error, with the place, for bad syntax, and where there is no file; `wanted`
/// says what it should be.
inline toml::table parseToml(const std::filesystem::path& file, const std::string& wanted) {
  if (!std::filesystem::is_regular_file(file))
    throw Error({.what = "no such file", .where = {file.string()}, .wanted = wanted});
  try {
    return toml::parse_file(file.string());
  } catch (const toml::parse_error& error) {
    const auto& begin = error.source().begin;
    throw Error({.what = std::string(error.description()),
                 .where = {file.string(), static_cast<int>(begin.line), static_cast<int>(begin.column)}});
  }
}

}  // namespace rex::grading::internal
