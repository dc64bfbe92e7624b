#pragma once

#include <string>
#include <utility>

#include "base/error.h"
#include "cli/terminal.h"

namespace rex::cli {

/// What `attempt()` returns. An Error that it throws becomes a UsageError that begins with `option`: what the
/// user gave cannot be used, and the project is not at fault.
template <class Attempt>
auto asWrongUse(const Attempt& attempt, const std::string& option = "") {
  try {
    return attempt();
  } catch (const Error& error) {
    ErrorParts parts = error.parts();
    parts.what = harmless(option + parts.what);
    throw UsageError(std::move(parts));
  }
}

}  // namespace rex::cli
