#pragma once

#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/error.h"
#include "base/join.h"
#include "cli/terminal.h"

namespace rex::cli {

/// What a name means. Throws UsageError for another one, with all choices and the nearest.
template <typename Value>
Value choose(const char* option, const std::string& name,
             const std::vector<std::pair<std::string, Value>>& choices) {
  std::vector<std::string> names;
  for (const auto& [known, value] : choices) {
    if (name == known) return value;
    names.push_back(known);
  }
  throw UsageError({.what = option,
                    .found = "'" + harmless(name) + "'",
                    .wanted = join(names, ", "),
                    .nearest = nearestNames(name, names)});
}

/// Throws UsageError for a number that is out of range, or none.
inline void requireBetween(const char* option, double number, double least, double most) {
  if (number >= least && number <= most) return;
  throw UsageError({.what = option,
                    .found = fmt::format("{:.9g}", number),
                    .wanted = fmt::format("{:g} to {:g}", least, most)});
}

}  // namespace rex::cli
