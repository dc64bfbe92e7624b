#pragma once

#include <functional>

#include "planning/space.h"
#include "planning/validity.h"

namespace rex {

class Rng;

/// Proposes a node for a roadmap, valid or not; false: not this time.
using Sampler = std::function<bool(Rng& rng, Eigen::Ref<Eigen::VectorXd> q)>;

/// Any configuration.
[[nodiscard]] Sampler uniformSampler(const Space& space);

/// A valid configuration beside one that is not, `sigma` away on average: nodes gather around obstacles.
/// Slide 4:35; Boor, Overmars and van der Stappen 1999. Throws Error for a sigma that is not positive.
[[nodiscard]] Sampler gaussianSampler(const Space& space, AllValid allValid, double sigma);

/// A valid configuration in the middle between two that are not: nodes gather in narrow passages. Slide 4:35;
/// Hsu, Jiang, Reif and Sun 2003. Throws as gaussianSampler.
[[nodiscard]] Sampler bridgeSampler(const Space& space, AllValid allValid, double sigma);

/// Any configuration through which a way from start to goal may lead that is shorter than `length`: what is
/// left to look at once one of that length is known (Gammell, Srinivasa and Barfoot 2014). Throws Error for a
/// length below the distance of start and goal.
[[nodiscard]] Sampler informedSampler(const Space& space, const VectorArg& start, const VectorArg& goal,
                                      double length);

}  // namespace rex
