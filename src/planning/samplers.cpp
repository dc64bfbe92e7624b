#include "planning/samplers.h"

#include <cassert>
#include <utility>

#include <fmt/format.h>

#include "base/error.h"
#include "base/require.h"
#include "base/rng.h"
#include "geometry/rotation.h"
#include "planning/path_problem.h"

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

namespace {

// A normally distributed step away, with deviation sigma in each dimension by the metric of the space, within
// its bounds.
bool stepAway(const Space& space, const VectorArg& from, double sigma, Rng& rng,
              Eigen::Ref<Eigen::VectorXd> to) {
  Eigen::Index i = 0;
  for (const SpacePart& part : space.parts()) {
    const double spread = sigma / part.weight;
    if (part.kind == SpacePart::Kind::kQuaternion) {
      // A turn by a moves a unit quaternion by 2 sin(a / 4), about a / 2.
      const Eigen::Vector3d turn = 2 * spread * rng.normalVector(3);
      to.segment<4>(i) =
          quaternionProduct(from.segment<4>(i), quaternionFromRotation(expSO3(turn))).normalized();
    } else {
      to[i] = from[i] + spread * rng.normal();
      if (part.kind == SpacePart::Kind::kLine && (to[i] < part.lower || to[i] > part.upper)) return false;
    }
    i += coordinateCount(part.kind);
  }
  return true;
}

}  // namespace

Sampler uniformSampler(const Space& space) {
  return [space](Rng& rng, Eigen::Ref<Eigen::VectorXd> q) {
    space.sample(rng, q);
    return true;
  };
}

Sampler gaussianSampler(const Space& space, AllValid allValid, double sigma) {
  requirePositive("sigma of a sampler", sigma);
  return [=, allValid = std::move(allValid), other = Eigen::VectorXd(space.size())](
             Rng& rng, Eigen::Ref<Eigen::VectorXd> q) mutable {
    space.sample(rng, q);
    if (!stepAway(space, q, sigma, rng, other)) return false;
    const bool isFirst = allValid(q), isSecond = allValid(other);
    if (!isFirst) q = other;
    return isFirst != isSecond;
  };
}

Sampler bridgeSampler(const Space& space, AllValid allValid, double sigma) {
  requirePositive("sigma of a sampler", sigma);
  return [=, allValid = std::move(allValid), one = Eigen::VectorXd(space.size()),
          other = Eigen::VectorXd(space.size())](Rng& rng, Eigen::Ref<Eigen::VectorXd> q) mutable {
    space.sample(rng, one);
    if (!stepAway(space, one, sigma, rng, other) || allValid(one) || allValid(other)) return false;
    space.interpolate(one, other, .5, q);
    return allValid(q);
  };
}

Sampler informedSampler(const Space& space, const VectorArg& start, const VectorArg& goal, double length) {
  const double apart = space.distance(start, goal);
  if (!(length >= apart)) {
    throw Error({.what = "length of a path",
                 .found = fmt::format("{:g}", length),
                 .wanted = fmt::format("at least {:g}, the distance from start to goal", apart)});
  }
  return [space, start = Eigen::VectorXd(start), goal = Eigen::VectorXd(goal), length](
             Rng& rng, Eigen::Ref<Eigen::VectorXd> q) {
    space.sample(rng, q);
    return lengthThrough(space, start, q, goal) < length;
  };
}

}  // namespace rex
