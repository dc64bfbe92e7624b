#include "planning/samplers.h"

#include <utility>

#include <fmt/format.h>

#include "base/error.h"
#include "base/require.h"
#include "base/rng.h"
#include "geometry/rotation.h"
#include "planning/path_problem.h"

namespace rex {
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
