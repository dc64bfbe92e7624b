#include "locomotion/basin.h"

#include "base/error.h"
#include "base/require.h"

namespace rex {
namespace {

using Eigen::Vector4d;

void requireFound(const LimitCycle& cycle) {
  if (cycle.status != LimitCycle::Status::kFound)
    throw Error(
        {.what = "basin of attraction: limit cycle", .found = cycle.message, .wanted = "one that was found"});
}

void requireStable(const LimitCycle& cycle) {
  requireFound(cycle);
  if (!cycle.isStable)
    throw Error(
        {.what = "basin of attraction: limit cycle", .found = cycle.message, .wanted = "a stable one"});
}

BasinOutcome walk(const CompassGait& walker, const Vector4d& goal, Vector4d x, const BasinOptions& options) {
  BasinOutcome outcome;
  while ((x - goal).cwiseAbs().maxCoeff() > options.tolerance) {
    if (outcome.steps == options.maxSteps) return outcome;
    const WalkerStep step = walker.step(x, options.timeLimit);
    outcome.last = step.status;
    if (step.status != StepStatus::kStepped) {
      outcome.status = BasinOutcome::Status::kFell;
      return outcome;
    }
    ++outcome.steps;
    x = step.after;
  }
  outcome.status = BasinOutcome::Status::kReached;
  return outcome;
}

}  // namespace

std::vector<BasinOutcome> basinOfAttraction(const CompassGait& walker, const LimitCycle& cycle,
                                            const Eigen::Ref<const Eigen::Matrix4Xd>& starts,
                                            const BasinOptions& options) {
  requireStable(cycle);
  requireCount("basin of attraction: steps", options.maxSteps, 1);
  requirePositive("basin of attraction: tolerance", options.tolerance);
  std::vector<BasinOutcome> outcomes;
  outcomes.reserve(static_cast<std::size_t>(starts.cols()));
  for (const auto& start : starts.colwise()) outcomes.push_back(walk(walker, cycle.x, start, options));
  return outcomes;
}

Eigen::Matrix4Xd basinGrid(const CompassGait& walker, const LimitCycle& cycle,
                           const Eigen::Ref<const Eigen::VectorXd>& stanceAngles,
                           const Eigen::Ref<const Eigen::VectorXd>& stanceRates) {
  requireFound(cycle);
  Eigen::Matrix4Xd starts(4, stanceAngles.size() * stanceRates.size());
  const double share = cycle.x[3] / cycle.x[2];
  Eigen::Index column = 0;
  for (const double stanceRate : stanceRates)
    for (const double angle : stanceAngles)
      starts.col(column++) << angle, -angle - 2 * walker.slope, stanceRate, share * stanceRate;
  return starts;
}

}  // namespace rex
