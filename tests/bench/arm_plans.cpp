#include "bench/arm_plans.h"

#include <memory>
#include <numbers>
#include <stdexcept>

#include "base/rng.h"
#include "bench/cpu_seconds.h"
#include "planning/robot_problem.h"
#include "planning/rrt.h"

namespace rex::bench {
namespace {

ArmPlan planTo(const ContactScene& scene, const Eigen::VectorXd& goal) {
  const Eigen::VectorXd half = Eigen::VectorXd::Constant(goal.size(), std::numbers::pi);
  PathProblem problem = robotProblem(scene.model, scene.contacts, 0 * goal, goal);
  problem.space = Space::box(-half, half);
  const double extent = problem.space.distance(-half, half);
  problem.resolution = .01 * extent;
  return {problem, .2 * extent};
}

}  // namespace

ArmPlan tipInHole(const ContactScene& scene) {
  Eigen::VectorXd q(7);
  q << -1.02008, 0.649037, 0.538341, -1.36882, -1.42144, 0.0874241, -0.555603;
  return planTo(scene, q);
}

ArmPlan pegInHole(const ContactScene& scene) {
  Eigen::VectorXd q(7);
  q << 1.14568, -0.607103, -0.941697, 1.37137, 1.98598, -1.48701, -1.41685;
  return planTo(scene, q);
}

Measurement ourConnect(const ArmPlan& plan) {
  return [plan, seed = std::make_shared<std::uint64_t>(0)] {
    Rng rng(++*seed);
    const double before = cpuSeconds();
    const PathResult result =
        connectRrts(plan.problem, {.stepSize = plan.range, .maxSamples = 10'000'000}, rng);
    const double seconds = cpuSeconds() - before;
    if (result.status != PathStatus::kFound) throw std::logic_error("no path to the hole");
    return seconds;
  };
}

}  // namespace rex::bench
