#include "base/require_finite.h"

#include <cmath>
#include <string>

#include <fmt/format.h>

#include "base/error.h"

namespace rex {

void requireFinite(std::string_view what, double number) {
  if (std::isfinite(number)) return;
  // The sign bit of a NaN is unspecified.
  const std::string found = std::isnan(number) ? "nan" : fmt::format("{}", number);
  throw Error({.what = std::string(what), .found = found, .wanted = "a finite number"});
}

void requireFinite(std::string_view what, const Eigen::Ref<const Eigen::VectorXd>& numbers) {
  for (Eigen::Index i = 0; i < numbers.size(); ++i)
    if (!std::isfinite(numbers[i])) requireFinite(fmt::format("{}: number {}", what, i), numbers[i]);
}

}  // namespace rex
