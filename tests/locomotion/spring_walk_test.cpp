#include "locomotion/spring_walk.h"

#include <algorithm>
#include <cmath>

#include "support/expect_error.h"
#include "support/runge_kutta.h"

namespace rex::spring_walk_test {

using Eigen::Vector2d;
using Eigen::Vector4d;

// What Geyer, Seyfarth and Blickhan (2006) walk with: 80 kg, 1 m, 14 kN/m, 69 degrees, 816 J.
SpringLeg leg(double degrees = 69) { return {.stiffness = 14000, .angle = degrees * M_PI / 180}; }

MidStance ofEnergy(double joules, double height, double rise = 0) {
  const double atRest = totalEnergy(leg(), {.height = height, .speed = 0, .rise = rise});
  return {.height = height, .speed = std::sqrt(2 * (joules - atRest) / leg().mass), .rise = rise};
}

WalkingGait gaitOf(double joules, double height, double rise = 0) {
  return findWalkingGait(leg(), ofEnergy(joules, height, rise));
}

// The energy of the mass and of the legs that are on the ground: the spring of a foot at `way`, too.
double energyOnBoth(const WalkStep& step, const Vector4d& x) {
  const double compression = leg().restLength - std::hypot(x[0] - step.length, x[1]);
  return leg().stanceEnergy(x) + leg().stiffness / 2 * compression * compression;
}

TEST(SpringWalk, KeepsItsEnergy) {
  const MidStance from = ofEnergy(816, .965, .05);
  const WalkStep step = walkStep(leg(), from);
  ASSERT_EQ(step.status, WalkStatus::kStepped) << step.message;
  EXPECT_NEAR(leg().stanceEnergy(step.touchdown), 816, 1e-10);
  EXPECT_NEAR(energyOnBoth(step, step.takeoff), 816, 1e-10);
  EXPECT_NEAR(totalEnergy(leg(), step.next), 816, 1e-10);
  EXPECT_NEAR(step.touchdown[1], std::sin(leg().angle), 1e-14);
  EXPECT_NEAR(step.takeoff.head<2>().norm(), leg().restLength, 1e-14);
}

// The same step by the forces of its samples: momentum by Simpson's rule, and a fixed step of order four.
TEST(SpringWalk, MovesAsItsForcesSay) {
  const MidStance from = ofEnergy(816, .965, .05);
  constexpr int kCount = 401;
  const std::vector<WalkSample> samples = walkSamples(leg(), from, kCount);
  ASSERT_EQ(samples.size(), 3u * kCount);
  for (std::size_t phase = 0; phase < 3; ++phase) {
    const std::size_t first = phase * kCount;
    const double h = (samples[first + kCount - 1].time - samples[first].time) / (kCount - 1);
    Vector2d impulse = Vector2d::Zero();
    Vector4d x = samples[first].x;
    for (std::size_t i = 0; i < kCount; ++i) {
      const WalkSample& at = samples[first + i];
      const double weight = i == 0 || i == kCount - 1 ? 1 : i % 2 == 1 ? 4 : 2;
      impulse += weight * h / 3 * (at.hind + at.front - Vector2d(0, leg().mass * leg().g));
    }
    const Vector4d& last = samples[first + kCount - 1].x;
    EXPECT_LT((impulse - leg().mass * (last - x).tail<2>()).norm(), 1e-7) << phase;
  }
  const WalkStep step = walkStep(leg(), from);
  EXPECT_LT((samples[kCount - 1].x - step.touchdown).norm(), 1e-12);
  EXPECT_LT((samples[2 * kCount - 1].x - step.takeoff).norm(), 1e-12);
}

TEST(SpringWalk, StandsOnOneLegAsARunnerDoes) {
  const MidStance from = ofEnergy(816, .965, .05);
  const WalkStep step = walkStep(leg(), from);
  const double alone = walkSamples(leg(), from, 2)[1].time;
  Vector4d x(0, from.height, from.speed, from.rise);
  constexpr int kSteps = 2000;
  for (int i = 0; i < kSteps; ++i)
    x = rungeKutta4Step([&](const Vector4d& y) { return leg().stanceDerivative(y); }, x, alone / kSteps);
  EXPECT_LT((x - step.touchdown).norm(), 1e-10);
}

TEST(WalkingGait, IsThatOfThePaper) {
  const WalkingGait gait = gaitOf(816, .97);
  ASSERT_EQ(gait.status, WalkingGait::Status::kFound) << gait.message;
  EXPECT_TRUE(gait.isStable);
  const WalkStep step = walkStep(leg(), gait.at);
  // About 1.1 m/s on average, and a step ends as it began, seen in a mirror.
  EXPECT_NEAR(step.length / step.time, 1.1, .1);
  const Vector4d mirrored(step.length - step.touchdown[0], step.touchdown[1], step.touchdown[2],
                          -step.touchdown[3]);
  EXPECT_LT((step.takeoff - mirrored).norm(), 1e-10);
  // The vertical force of a leg has two humps, with a valley at mid-stance below the weight: people walk so.
  const std::vector<WalkSample> samples = walkSamples(leg(), gait.at, 50);
  const double weight = leg().mass * leg().g, middle = samples.front().hind[1];
  const double hump =
      std::ranges::max_element(samples, {}, [](const WalkSample& s) { return s.hind[1]; })->hind[1];
  EXPECT_LT(middle, .7 * weight);
  EXPECT_GT(hump, weight);
}

// From a centimetre beside it the walker comes closer step by step, as the multiplier says.
TEST(WalkingGait, DrawsWalkersIn) {
  const WalkingGait gait = gaitOf(830, .97);
  ASSERT_TRUE(gait.isStable) << gait.message;
  const double largest = std::max(std::abs(gait.multipliers[0]), std::abs(gait.multipliers[1]));
  MidStance at = ofEnergy(830, gait.at.height + .002);
  const auto away = [&] { return std::hypot(at.height - gait.at.height, at.rise - gait.at.rise); };
  double before = 0;
  for (int i = 0; i < 80; ++i) {
    if (i == 40) before = away();
    const WalkStep step = walkStep(leg(), at);
    ASSERT_EQ(step.status, WalkStatus::kStepped) << i << ": " << step.message;
    at = step.next;
  }
  EXPECT_LT(away(), 1e-6);
  EXPECT_NEAR(std::log(away() / before) / 40, std::log(largest), .05);
}

// A gait that is no mirror image of itself: the mass rises or falls at mid-stance.
TEST(WalkingGait, NeedNotBeSymmetric) {
  const WalkingGait gait = findWalkingGait(leg(71), ofEnergy(830, .98));
  ASSERT_EQ(gait.status, WalkingGait::Status::kFound) << gait.message;
  EXPECT_GT(std::abs(gait.at.rise), .05);
  const WalkStep step = walkStep(leg(71), gait.at);
  EXPECT_NEAR(step.next.height, gait.at.height, 1e-11);
  EXPECT_NEAR(step.next.rise, gait.at.rise, 1e-11);
}

TEST(WalkingGait, MayBeUnstable) {
  const WalkingGait gait = gaitOf(800, .95);
  ASSERT_EQ(gait.status, WalkingGait::Status::kFound) << gait.message;
  EXPECT_FALSE(gait.isStable);
  EXPECT_THAT(gait.message, testing::StartsWith("found: unstable, largest multiplier 1.30"));
}

TEST(SpringWalk, SaysHowItFails) {
  const auto ends = [](const SpringLeg& one, const MidStance& from, WalkStatus status, const char* message,
                       double limit = kLongestPhase) {
    const WalkStep step = walkStep(one, from, limit);
    EXPECT_EQ(step.status, status) << step.message;
    EXPECT_THAT(step.message, testing::StartsWith(message));
  };
  ends(leg(), {.height = .9}, WalkStatus::kTooLow, "is too low to set the leg after 0 s");
  ends(leg(), {.height = .97, .speed = 4}, WalkStatus::kTookOff, "took off after ");
  ends(leg(), {.height = .97, .speed = 1}, WalkStatus::kTimeLimit, "did not reach the next foot after 0.01 s",
       .01);
  const SpringLeg soft{.stiffness = 800, .angle = 50 * M_PI / 180};
  ends(soft, {.height = .78, .speed = -1, .rise = -1}, WalkStatus::kTookOff,
       "the front leg lifted off after ");
  ends(soft, {.height = .78, .speed = -.7, .rise = -1}, WalkStatus::kFell, "fell after ");
  ends(soft, {.height = .78, .speed = 1.9}, WalkStatus::kRushed, "passed the front foot on both legs after ");
  EXPECT_EQ(findWalkingGait(leg(), {.height = .9}).status, WalkingGait::Status::kFell);
  EXPECT_EQ(findWalkingGait(leg(), {.height = .9}).message,
            "from 0.9 m above the foot: is too low to set the leg after 0 s");
}

TEST(SpringWalk, NamesWhatIsWrong) {
  EXPECT_REX_ERROR(walkStep({.mass = 0}, {}), "spring leg: mass: found 0");
  EXPECT_REX_ERROR(walkStep({}, {.height = NAN}), "spring walk: height: found nan");
  EXPECT_REX_ERROR(walkStep({}, {.speed = NAN}), "spring walk: speed: found nan");
  EXPECT_REX_ERROR(walkStep({}, {.rise = NAN}), "spring walk: rise: found nan");
  EXPECT_REX_ERROR(walkStep({}, {}, 0), "spring walk: time limit: found 0");
  EXPECT_REX_ERROR(walkSamples({}, {}, 1), "spring walk: number of samples: found 1, wanted at least 2");
}

}  // namespace rex::spring_walk_test
