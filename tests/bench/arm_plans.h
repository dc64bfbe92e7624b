#pragma once

#include <functional>

#include "bench/contact_scene.h"
#include "bench/row.h"
#include "planning/path_problem.h"

namespace rex::bench {

/// The arm shall go from its zero posture to where 0.1 or 0.35 m of the peg are in the hole of the frame;
/// ways are checked at points a hundredth of the largest distance apart.
struct ArmPlan {
  PathProblem problem;
  double range;  ///< how far trees grow at once: a fifth of the largest distance, as OMPL has it
};
[[nodiscard]] ArmPlan tipInHole(const ContactScene& scene);
[[nodiscard]] ArmPlan pegInHole(const ContactScene& scene);

/// CPU time of one search by RRT-Connect, each time with another seed. Throw std::logic_error where there is
/// no path.
[[nodiscard]] Measurement ourConnect(const ArmPlan& plan);
/// OMPL with FCL; empty: one of them is not installed.
#ifdef REX_WITH_OMPL
[[nodiscard]] Measurement omplConnect(const ContactScene& scene, const ArmPlan& plan);
#else
[[nodiscard]] inline Measurement omplConnect(const ContactScene&, const ArmPlan&) { return {}; }
#endif

}  // namespace rex::bench
