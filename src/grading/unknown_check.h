#pragma once

#include <string>
#include <vector>

#include "base/error.h"

namespace rex::grading {

/// The error for a check that does not exist; it suggests the most similar names among `known`, or all.
[[nodiscard]] inline UsageError unknownCheck(const std::string& id, const std::vector<std::string>& known,
                                             SourceLocation where = {}) {
  std::vector<std::string> nearest = nearestNames(id, known);
  std::string all;
  for (const std::string& name : known) all += (all.empty() ? "one of " : ", ") + name;
  return UsageError({.what = "no check is called '" + id + "'",
                     .where = std::move(where),
                     .wanted = nearest.empty() ? all : "",
                     .nearest = std::move(nearest)});
}

}  // namespace rex::grading
