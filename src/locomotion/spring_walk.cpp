#include "locomotion/spring_walk.h"

#include <algorithm>
#include <optional>

#include <Eigen/LU>
#include <fmt/format.h>

#include "base/require.h"
#include "systems/event_integration.h"

namespace rex {
namespace {

using Eigen::Vector2d;
using Eigen::Vector4d;
using WalkEvent = internal::Event<Vector4d>;

void requireMidStance(const MidStance& at) {
  requireFinite("spring walk: height", at.height);
  requireFinite("spring walk: speed", at.speed);
  requireFinite("spring walk: rise", at.rise);
}

// Of a leg with its foot on the ground at `foot`.
double lengthOf(const Vector4d& x, double foot) { return std::hypot(x[0] - foot, x[1]); }
double stretchingOf(const Vector4d& x, double foot) { return (x[0] - foot) * x[2] + x[1] * x[3]; }
Vector2d pushOf(const SpringLeg& leg, const Vector4d& x, double foot) {
  const double length = lengthOf(x, foot);
  return leg.stiffness * (leg.restLength - length) / length * Vector2d(x[0] - foot, x[1]);
}

// A part of a step, with the same feet on the ground.
struct StepPart {
  bool hind = true, front = true;
  double way = 0;                 // of the front foot from the hind one
  Vector4d x = Vector4d::Zero();  // at its begin
  double time = 0;                // that it takes

  [[nodiscard]] Vector4d rate(const SpringLeg& leg, const Vector4d& at) const {
    Vector2d a(0, -leg.g);
    if (hind) a += pushOf(leg, at, 0) / leg.mass;
    if (front) a += pushOf(leg, at, way) / leg.mass;
    return {at[2], at[3], a[0], a[1]};
  }
  // After some time, or at an event.
  [[nodiscard]] internal::EventPoint<Vector4d> follow(const SpringLeg& leg, double end,
                                                      std::span<const WalkEvent> events) const {
    return internal::integrateToEvent<Vector4d>([&](const Vector4d& at) { return rate(leg, at); }, x, end,
                                                0.1 * std::sqrt(leg.mass / leg.stiffness), events);
  }
};

// A foot lifts off as its leg is at rest length and getting longer.
WalkEvent liftOff(const SpringLeg& leg, double foot) {
  return {[l = leg.restLength, foot](const Vector4d& x) {
    return std::max(l - lengthOf(x, foot), -stretchingOf(x, foot));
  }};
}

const WalkEvent kMassDown{[](const Vector4d& x) { return x[1]; }};

// A step while it goes on.
struct Walking {
  const SpringLeg& leg;
  double timeLimit;
  Vector4d x;
  WalkStep step{};
  std::vector<StepPart> phases{};

  // Follows a phase to one of three events; none if its time is over.
  std::optional<int> follow(StepPart phase, const std::array<WalkEvent, 3>& events) {
    phase.x = x;
    const auto end = phase.follow(leg, timeLimit, std::span(events));
    x = end.x;
    step.time += phase.time = end.t;
    if (phase.hind && phase.front) step.doubleTime = end.t;
    phases.push_back(phase);
    return end.event;
  }

  WalkStep ended(WalkStatus status, const char* what) {
    step.status = status;
    step.message = fmt::format("{} after {:.6g} s", what, step.time);
    return step;
  }
};

Walking beginning(const SpringLeg& leg, const MidStance& from, double timeLimit) {
  static_cast<void>(totalEnergy(leg, from));  // throws for numbers that are none
  return {.leg = leg, .timeLimit = timeLimit, .x = {0, from.height, from.speed, from.rise}};
}

constexpr const char* kNoFoot = "took off";
constexpr const char* kLate = "did not reach the next foot";

WalkStep walkThrough(Walking& walk) {
  const SpringLeg& leg = walk.leg;
  enum : int { kNext, kLift, kFall };
  const double setting = leg.restLength * std::sin(leg.angle);
  if (!(walk.x[1] > setting)) return walk.ended(WalkStatus::kTooLow, "is too low to set the leg");
  const WalkEvent touchdown{[=](const Vector4d& x) { return x[1] - setting; }};
  std::optional<int> event = walk.follow({.front = false}, {touchdown, liftOff(leg, 0), kMassDown});
  walk.step.touchdown = walk.x;
  if (!event) return walk.ended(WalkStatus::kTimeLimit, kLate);
  if (*event != kNext) return walk.ended(WalkStatus::kTookOff, kNoFoot);

  const double way = walk.step.length = walk.x[0] + leg.restLength * std::cos(leg.angle);
  if (stretchingOf(walk.x, way) >= 0) return walk.ended(WalkStatus::kTookOff, kNoFoot);
  event = walk.follow({.way = way}, {liftOff(leg, 0), liftOff(leg, way), kMassDown});
  walk.step.takeoff = walk.x;
  if (!event) return walk.ended(WalkStatus::kTimeLimit, kLate);
  if (*event == kLift) return walk.ended(WalkStatus::kTookOff, "the front leg lifted off");
  if (*event == kFall) return walk.ended(WalkStatus::kFell, "fell");
  if (walk.x[0] >= way) return walk.ended(WalkStatus::kRushed, "passed the front foot on both legs");

  const WalkEvent above{[=](const Vector4d& x) { return way - x[0]; }};
  event = walk.follow({.hind = false, .way = way}, {above, liftOff(leg, way), kMassDown});
  if (!event) return walk.ended(WalkStatus::kTimeLimit, kLate);
  if (*event == kLift) return walk.ended(WalkStatus::kTookOff, kNoFoot);
  if (*event == kFall) return walk.ended(WalkStatus::kFell, "fell");
  walk.step.next = {.height = walk.x[1], .speed = walk.x[2], .rise = walk.x[3]};
  return walk.ended(WalkStatus::kStepped, "stepped");
}

// The mid-stances of one energy: height, and rise.
struct StanceFamily {
  double energy;

  [[nodiscard]] MidStance at(const SpringLeg& leg, const Vector2d& z) const {
    const double compression = leg.restLength - z[0],
                 square = 2 / leg.mass * (energy - leg.stiffness / 2 * compression * compression) -
                          2 * leg.g * z[0] - z[1] * z[1];
    return {.height = z[0], .speed = std::sqrt(std::max(square, 0.)), .rise = z[1]};
  }
};

Vector2d coordinates(const MidStance& at) { return {at.height, at.rise}; }

// A mid-stance of a family, and how a step changes it.
struct StepTrial {
  MidStance at;
  Vector2d change = Vector2d::Zero();
  Eigen::Matrix2d slope = Eigen::Matrix2d::Zero();
  std::optional<std::string> failure{};

  StepTrial(const SpringLeg& leg, const StanceFamily& family, const Vector2d& z) : at(family.at(leg, z)) {
    constexpr double kDifference = 1e-5;
    const auto next = [&](const Vector2d& from) {
      const WalkStep step = walkStep(leg, family.at(leg, from));
      if (step.status != WalkStatus::kStepped) failure = step.message;
      return coordinates(step.next);
    };
    change = next(z) - z;
    for (int i = 0; i < 2; ++i) {
      const Vector2d way = kDifference * Vector2d::Unit(i);
      slope.col(i) = (next(z + way) - next(z - way)) / (2 * kDifference);
    }
  }

  [[nodiscard]] double residual() const { return change.cwiseAbs().maxCoeff(); }
};

// Halves Newton's step until the walker can step from there and the residual falls.
bool approach(const SpringLeg& leg, const StanceFamily& family, StepTrial& trial) {
  const Eigen::Matrix2d toSolve = Eigen::Matrix2d::Identity() - trial.slope;
  const Vector2d way = toSolve.inverse() * trial.change;
  for (double share = 1; share > 1e-4; share /= 2) {
    const StepTrial next(leg, family, coordinates(trial.at) + share * way);
    if (next.failure || !(next.residual() < trial.residual())) continue;
    trial = next;
    return true;
  }
  return false;
}

std::array<std::complex<double>, 2> eigenvaluesOf(const Eigen::Matrix2d& A) {
  const double half = A.trace() / 2;
  const std::complex<double> root = std::sqrt(std::complex<double>(half * half - A.determinant()));
  return {half + root, half - root};
}

}  // namespace

WalkStep walkStep(const SpringLeg& leg, const MidStance& from, double timeLimit) {
  requirePositive("spring walk: time limit", timeLimit);
  Walking walk = beginning(leg, from, timeLimit);
  return walkThrough(walk);
}

std::vector<WalkSample> walkSamples(const SpringLeg& leg, const MidStance& from, int count) {
  requireCount("spring walk: number of samples", count, 2);
  Walking walk = beginning(leg, from, kLongestPhase);
  static_cast<void>(walkThrough(walk));
  std::vector<WalkSample> samples;
  double before = 0;
  for (const StepPart& phase : walk.phases) {
    for (int i = 0; i < count; ++i) {
      const double time = phase.time * i / (count - 1);
      const Vector4d x = phase.follow(leg, time, {}).x;
      samples.push_back({.time = before + time, .x = x});
      if (phase.hind) samples.back().hind = pushOf(leg, x, 0);
      if (phase.front) samples.back().front = pushOf(leg, x, phase.way);
    }
    before += phase.time;
  }
  return samples;
}

double totalEnergy(const SpringLeg& leg, const MidStance& at) {
  requireMidStance(at);
  return leg.stanceEnergy({0, at.height, at.speed, at.rise});
}

WalkingGait findWalkingGait(const SpringLeg& leg, const MidStance& guess) {
  constexpr int kMostIterations = 50;
  constexpr double kClosest = 1e-12;
  const StanceFamily family{totalEnergy(leg, guess)};
  StepTrial trial(leg, family, coordinates(guess));
  WalkingGait gait;
  gait.message = fmt::format("not found in {} iterations", kMostIterations);
  for (; gait.iterations < kMostIterations; ++gait.iterations) {
    if (trial.failure || trial.residual() <= kClosest) break;
    if (!approach(leg, family, trial)) break;
  }
  gait.at = trial.at;
  gait.multipliers = eigenvaluesOf(trial.slope);
  gait.residual = trial.residual();
  if (trial.failure) {
    gait.status = WalkingGait::Status::kFell;
    gait.message = fmt::format("from {:.6g} m above the foot: {}", trial.at.height, *trial.failure);
  } else if (gait.residual <= kClosest) {
    const double largest = std::max(std::abs(gait.multipliers[0]), std::abs(gait.multipliers[1]));
    gait.status = WalkingGait::Status::kFound;
    gait.isStable = largest < 1;
    gait.message =
        fmt::format("found: {}, largest multiplier {:.6g}", gait.isStable ? "stable" : "unstable", largest);
  } else if (gait.iterations < kMostIterations) {
    gait.status = WalkingGait::Status::kStuck;
    gait.message = fmt::format("stuck: a step changes height or rise by {:.3g}", gait.residual);
  }
  return gait;
}

}  // namespace rex
