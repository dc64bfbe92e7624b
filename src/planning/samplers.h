#pragma once

#include <functional>

#include <Eigen/Core>

#include "planning/path_problem.h"
#include "planning/space.h"

namespace rex {

class Rng;

/// Proposes a node for a roadmap, valid or not. Returns false if it has none this time.
using Sampler = std::function<bool(Rng& rng, Eigen::Ref<Eigen::VectorXd> q)>;

/// Any configuration.
[[nodiscard]] Sampler uniformSampler(const Space& space);

/// A valid configuration near an invalid one, about `sigma` away: nodes gather around obstacles. Slide
/// 4:35; Boor, Overmars and van der Stappen 1999. Throws Error for a sigma that is not positive.
[[nodiscard]] Sampler gaussianSampler(const Space& space, AllValid allValid, double sigma);

/// A valid configuration midway between two invalid ones: nodes gather in narrow passages. Slide 4:35; Hsu,
/// Jiang, Reif and Sun 2003. Throws like gaussianSampler.
[[nodiscard]] Sampler bridgeSampler(const Space& space, AllValid allValid, double sigma);

/// Any configuration through which a path from start to goal shorter than `length` may lead; useful once a
/// path of that length is known (Gammell, Srinivasa and Barfoot 2014). Throws Error for a length below the
/// distance between start and goal.
[[nodiscard]] Sampler informedSampler(const Space& space, const VectorArg& start, const VectorArg& goal,
                                      double length);

}  // namespace rex
