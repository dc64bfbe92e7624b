#pragma once

#include <string>
#include <vector>

#include "base/error.h"

namespace rex::grading {

/// The error for a check that does not exist; it suggests the most similar names among `known`.
[[nodiscard]] inline UsageError unknownCheck(const std::string& id, const std::vector<std::string>& known,
                                             SourceLocation where = {}) {
  return UsageError({.what = "no check is called '" + id + "'",
                     .where = std::move(where),
                     .nearest = nearestNames(id, known)});
}

}  // namespace rex::grading
