#pragma once

#include <cmath>
#include <string>

#include <fmt/format.h>

#include "base/error.h"
#include "base/require_finite.h"

namespace rex::internal {

inline void requirePositive(const std::string& what, double number) {
  if (!(number > 0) || !std::isfinite(number))
    throw Error({.what = what, .found = fmt::format("{:g}", number), .wanted = "a positive number"});
}

inline void requireNotNegative(const std::string& what, double number) {
  if (!(number >= 0) || !std::isfinite(number))
    throw Error(
        {.what = what, .found = fmt::format("{:g}", number), .wanted = "a number that is not negative"});
}

}  // namespace rex::internal
