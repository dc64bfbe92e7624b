#include "planning/halton.h"

#include <cassert>

#include <fmt/format.h>

#include "base/error.h"

namespace rex {
namespace {

constexpr int kPrimes[] = {2,  3,  5,  7,  11, 13, 17, 19, 23, 29,  31,  37,  41,  43,  47,  53,
                           59, 61, 67, 71, 73, 79, 83, 89, 97, 101, 103, 107, 109, 113, 127, 131};
constexpr int kMostDimensions = std::size(kPrimes);

}  // namespace

Halton::Halton(int dimension, int first) {
  if (dimension < 1 || dimension > kMostDimensions)
    throw Error({.what = "dimension of a Halton sequence",
                 .found = fmt::format("{}", dimension),
                 .wanted = fmt::format("1 to {}", kMostDimensions)});
  if (first < 0)
    throw Error({.what = "first point of a Halton sequence",
                 .found = fmt::format("{}", first),
                 .wanted = "0 or more"});
  for (int j = 0; j < dimension; ++j) {
    Coordinate& coordinate = coordinates_.emplace_back();
    coordinate.base = kPrimes[j];
    for (int rest = first; rest > 0; rest /= coordinate.base) append(coordinate, rest % coordinate.base);
    coordinate.value = valueOf(coordinate);
  }
}

// Adds a leading digit to the index.
void Halton::append(Coordinate& coordinate, int digit) {
  coordinate.digits.push_back(digit);
  coordinate.weights.push_back((coordinate.weights.empty() ? 1 : coordinate.weights.back()) /
                               coordinate.base);
}

double Halton::valueOf(const Coordinate& coordinate) {
  double value = 0;
  for (std::size_t i = coordinate.digits.size(); i-- > 0;)
    value += coordinate.digits[i] * coordinate.weights[i];
  return value;
}

void Halton::next(Eigen::Ref<Eigen::VectorXf> point) {
  assert(point.size() == dimension());
  for (Eigen::Index j = 0; j < point.size(); ++j) {
    Coordinate& coordinate = coordinates_[static_cast<std::size_t>(j)];
    point[j] = static_cast<float>(coordinate.value);
    if (coordinate.digits.empty()) append(coordinate, 0);
    std::size_t i = 0;
    for (; coordinate.digits[i] == coordinate.base - 1; ++i) {
      coordinate.digits[i] = 0;
      if (i + 1 == coordinate.digits.size()) append(coordinate, 0);
    }
    ++coordinate.digits[i];
    coordinate.value = i == 0 ? coordinate.value + coordinate.weights[0] : valueOf(coordinate);
  }
}

}  // namespace rex
