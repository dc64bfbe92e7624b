#include "base/require.h"

#include <cmath>
#include <string>

#include <fmt/format.h>

#include "base/error.h"

namespace rex {
namespace {

std::string numberOf(const Unit& unit) {
  return unit.name.empty() ? "number" : fmt::format("number of {}", unit.name);
}

[[noreturn]] void refuse(std::string_view what, double number, const Unit& unit, const std::string& wanted) {
  // The sign bit of a NaN is unspecified.
  std::string found = std::isnan(number) ? "nan" : fmt::format("{:g}", number);
  if (!std::isnan(number) && !unit.symbol.empty()) found += fmt::format(" {}", unit.symbol);
  throw Error({.what = std::string(what), .found = found, .wanted = wanted});
}

}  // namespace

void requirePositive(std::string_view what, double number, const Unit& unit) {
  if (number > 0 && std::isfinite(number)) return;
  refuse(what, number, unit, "a positive, finite " + numberOf(unit));
}

void requirePositiveOrInfinite(std::string_view what, double number, const Unit& unit) {
  if (number > 0) return;
  refuse(what, number, unit, "a positive " + numberOf(unit) + ", or infinity");
}

void requireNotNegative(std::string_view what, double number, const Unit& unit) {
  if (number >= 0 && std::isfinite(number)) return;
  refuse(what, number, unit, "a finite " + numberOf(unit) + ", 0 or more");
}

void requireNotNegative(std::string_view what, const Eigen::Ref<const Eigen::VectorXd>& numbers) {
  for (Eigen::Index i = 0; i < numbers.size(); ++i)
    if (!(numbers[i] >= 0) || !std::isfinite(numbers[i]))
      requireNotNegative(fmt::format("{}: number {}", what, i), numbers[i]);
}

void requireNotNegativeOrInfinite(std::string_view what, double number, const Unit& unit) {
  if (number >= 0) return;
  refuse(what, number, unit, "a " + numberOf(unit) + ", 0 or more, or infinity");
}

void requireFinite(std::string_view what, double number, const Unit& unit) {
  if (std::isfinite(number)) return;
  refuse(what, number, unit, "a finite " + numberOf(unit));
}

void requireFinite(std::string_view what, const Eigen::Ref<const Eigen::VectorXd>& numbers) {
  for (Eigen::Index i = 0; i < numbers.size(); ++i)
    if (!std::isfinite(numbers[i])) requireFinite(fmt::format("{}: number {}", what, i), numbers[i]);
}

void requireCount(std::string_view what, long long count, long long least) {
  if (count >= least) return;
  throw Error({.what = std::string(what),
               .found = fmt::format("{}", count),
               .wanted = least == 0 ? "0 or more" : fmt::format("at least {}", least)});
}

}  // namespace rex
