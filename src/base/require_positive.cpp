#include "base/require_positive.h"

#include <cmath>
#include <string>

#include <fmt/format.h>

#include "base/error.h"

namespace rex {

void requirePositive(std::string_view what, double number) {
  if (!(number > 0) || !std::isfinite(number))
    throw Error(
        {.what = std::string(what), .found = fmt::format("{:g}", number), .wanted = "a positive number"});
}

void requireNotNegative(std::string_view what, double number) {
  if (!(number >= 0) || !std::isfinite(number))
    throw Error({.what = std::string(what),
                 .found = fmt::format("{:g}", number),
                 .wanted = "a number that is not negative"});
}

}  // namespace rex
