#include "locomotion/limit_cycle.h"

#include <algorithm>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <fmt/format.h>

#include "base/error.h"
#include "base/require.h"

namespace rex {
namespace {

using Eigen::Matrix4d;
using Eigen::Vector4cd;
using Eigen::Vector4d;
using Status = LimitCycle::Status;

Vector4cd multipliersOf(const Matrix4d& J) {
  Vector4cd values = Eigen::EigenSolver<Eigen::MatrixXd>(J, false).eigenvalues();
  std::sort(values.begin(), values.end(), [](const auto& s, const auto& t) {
    return std::abs(s) != std::abs(t) ? std::abs(s) > std::abs(t) : s.imag() > t.imag();
  });
  return values;
}

constexpr double kShortestStep = 1e-9;  // radians between the legs; events of a step are located to 1e-12

// A state, its step, and by how much the step fails to return to it.
struct Trial {
  Vector4d x;
  WalkerStepJacobian map;
  double residual;

  Trial(const CompassGait& walker, const Vector4d& at, double timeLimit)
      : x(at),
        map(walker.stepJacobian(at, timeLimit)),
        residual((map.step.after - at).cwiseAbs().maxCoeff()) {}
  [[nodiscard]] bool stepped() const { return map.step.status == StepStatus::kStepped; }
  [[nodiscard]] bool repeats(double tolerance) const {
    return residual <= tolerance * x.cwiseAbs().maxCoeff();
  }
};

// Halves Newton's step until the walker can step from there and the residual falls.
bool advance(const CompassGait& walker, double timeLimit, Trial& at) {
  const Eigen::MatrixXd slope = Matrix4d::Identity() - at.map.J;
  const Eigen::VectorXd gap = at.map.step.after - at.x;
  const Vector4d way = slope.fullPivLu().solve(gap);
  for (double share = 1; share > 1e-4; share /= 2) {
    const Trial next(walker, at.x + share * way, timeLimit);
    if (!next.stepped() || !(next.residual < at.residual)) continue;
    at = next;
    return true;
  }
  return false;
}

LimitCycle ended(LimitCycle cycle, Status status, std::string message) {
  cycle.status = status;
  cycle.message = std::move(message);
  return cycle;
}

LimitCycle found(LimitCycle cycle) {
  const double between = std::abs(cycle.x[0] - cycle.x[1]);
  if (between < kShortestStep)
    return ended(cycle, Status::kNoGait,
                 fmt::format("no gait: a step of {:.3g} rad cannot be distinguished from standing", between));
  const double growth = std::abs(cycle.multipliers[0]);
  cycle.isStable = growth < 1;
  return ended(
      cycle, Status::kFound,
      fmt::format("found: {}, largest multiplier {:.6g}", cycle.isStable ? "stable" : "unstable", growth));
}

}  // namespace

LimitCycle findLimitCycle(const CompassGait& walker, const Vector4d& guess,
                          const LimitCycleOptions& options) {
  requireCount("limit cycle: iterations", options.maxIterations, 1);
  requirePositive("limit cycle: tolerance", options.tolerance);
  Trial at(walker, guess, options.timeLimit);
  LimitCycle cycle{.x = guess, .residual = at.residual};
  if (walker.slope <= 0)
    return ended(cycle, Status::kNoGait,
                 "no gait: on level ground and uphill nothing replaces the energy that impacts lose");
  if (!at.stepped()) return ended(cycle, Status::kFell, "from the guess: " + at.map.step.message);
  bool comesNearer = true;
  while (cycle.iterations < options.maxIterations && !at.repeats(options.tolerance)) {
    comesNearer = advance(walker, options.timeLimit, at);
    if (!comesNearer) break;
    ++cycle.iterations;
  }
  cycle.x = at.x;
  cycle.residual = at.residual;
  cycle.period = at.map.step.time;
  cycle.multipliers = multipliersOf(at.map.J);
  if (at.repeats(options.tolerance)) return found(cycle);
  if (!comesNearer)
    return ended(cycle, Status::kStuck,
                 fmt::format("stuck: a step changes the state by {:.3g}", at.residual));
  return ended(cycle, Status::kIterationLimit,
               fmt::format("not found in {} iterations", options.maxIterations));
}

}  // namespace rex
