#include "control/pid.h"

#include <cmath>

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include "base/rng.h"
#include "control/point_mass.h"
#include "support/expect_error.h"

namespace rex::pid_test {

// The closed loop of slide 3:15 in (q, v, integral), for target zero.
Eigen::Matrix3d closedLoop(double mass, const PidGains& gains) {
  Eigen::Matrix3d A;
  A << 0, 1, 0, -gains.Kp / mass, -gains.Kd / mass, gains.Ki / mass, -1, 0, 0;
  return A;
}

double slowestRate(double mass, const PidGains& gains) {
  return Eigen::EigenSolver<Eigen::MatrixXd>(closedLoop(mass, gains)).eigenvalues().real().maxCoeff();
}

TEST(PidIsStable, AgreesWithTheEigenvalues) {
  Rng rng(1);
  int stable = 0, compared = 0;
  for (int i = 0; i < 2000; ++i) {
    const Eigen::Vector3d g = rng.uniformVector(3, -0.5, 3);
    const double mass = rng.uniform(0.1, 5), rate = slowestRate(mass, {g[0], g[1], g[2]});
    if (std::abs(rate) < 1e-6) continue;
    ++compared;
    const bool isStable = pidIsStable(mass, {g[0], g[1], g[2]});
    EXPECT_EQ(isStable, rate < 0) << g.transpose() << " " << mass;
    stable += isStable;
  }
  EXPECT_GT(compared, 1900);
  EXPECT_GT(stable, 300);
  EXPECT_LT(stable, 1700);
}

TEST(PidIsStable, KnowsTheExercise) {
  EXPECT_FALSE(pidIsStable(1, {.Ki = 1}));            // 5.1c: integral feedback alone
  EXPECT_FALSE(pidIsStable(1, {.Ki = 1, .Kd = 10}));  // nor with damping
  EXPECT_FALSE(pidIsStable(1, {.Kp = 1}));            // oscillates for ever
  EXPECT_TRUE(pidIsStable(1, {.Kp = 1, .Kd = 0.1}));
  EXPECT_TRUE(pidIsStable(2, {.Kp = 3, .Ki = 1.49, .Kd = 1}));
  EXPECT_FALSE(pidIsStable(2, {.Kp = 3, .Ki = 1.51, .Kd = 1}));
}

// In other units the same loop: lengths of time as of another clock, and forces.
TEST(PidIsStable, DoesNotMindUnits) {
  for (const double unit : {1e-180, 1., 1e180}) {
    EXPECT_TRUE(pidIsStable(1, {.Kp = unit, .Kd = unit}));
    EXPECT_TRUE(pidIsStable(2 * unit, {.Kp = 3 * unit, .Ki = 1.49 * unit, .Kd = unit}));
    EXPECT_FALSE(pidIsStable(2 * unit, {.Kp = 3 * unit, .Ki = 1.51 * unit, .Kd = unit}));
  }
}

// A point mass under PID and a constant push, by small Euler steps: its greatest distance in the last tenth
// of the time.
double distanceLeft(double mass, const PidOptions& options, double push, double seconds) {
  const double h = 1e-3;
  const int steps = static_cast<int>(std::lround(seconds / h));
  Pid pid(options);
  PointMassState state{1, 0};
  double distance = 0;
  for (int i = 0; i < steps; ++i) {
    state = PointMass{mass}.eulerStep(state, pid.step(-state.q, -state.v, h) + push, h);
    if (i > steps * 9 / 10) distance = std::max(distance, std::abs(state.q));
  }
  return distance;
}

TEST(Pid, BringsAMassToItsTargetWhereItIsStable) {
  EXPECT_LT(distanceLeft(2, {.gains = {.Kp = 3, .Ki = 0.5, .Kd = 2}}, 0, 60), 1e-3);
  EXPECT_GT(distanceLeft(2, {.gains = {.Kp = 3, .Ki = 3, .Kd = 1}}, 0, 60), 10);
}

TEST(Pid, NeedsItsIntegralAgainstASteadyPush) {
  EXPECT_NEAR(distanceLeft(1, {.gains = {.Kp = 4, .Kd = 4}}, 2, 40), 2. / 4, 1e-6);
  EXPECT_LT(distanceLeft(1, {.gains = {.Kp = 4, .Ki = 2, .Kd = 4}}, 2, 40), 1e-6);
}

// Two steps by hand.
TEST(Pid, AddsUpTheErrorAfterItWasUsed) {
  Pid pid({.gains = {.Kp = 2, .Ki = 10, .Kd = 3}});
  EXPECT_EQ(pid.step(1, 0.5, 0.1), 2 * 1 + 3 * 0.5);
  EXPECT_DOUBLE_EQ(pid.integral(), 0.1);
  EXPECT_DOUBLE_EQ(pid.step(-2, 0, 0.1), 2 * -2 + 10 * 0.1);
  EXPECT_DOUBLE_EQ(pid.integral(), 0.1 - 0.2);
  pid.reset();
  EXPECT_EQ(pid.integral(), 0);
  EXPECT_EQ(pid.step(1, 0, 0.1), 2);
}

// How far a mass overshoots a target that a weak motor takes long to reach.
double overshoot(bool isLimited) {
  const double limit = 0.5, h = 1e-3;
  PidOptions options{.gains = {.Kp = 10, .Ki = 5, .Kd = 8}};
  if (isLimited) options.lowest = -limit, options.highest = limit;
  Pid pid(options);
  PointMassState state;
  double highest = 0;
  for (int i = 0; i < 20000; ++i) {
    const double u = std::clamp(pid.step(5 - state.q, -state.v, h), -limit, limit);
    state = PointMass{1}.eulerStep(state, u, h);
    highest = std::max(highest, state.q);
  }
  return highest - 5;
}

TEST(Pid, DoesNotWindUpWhenItKnowsItsLimits) {
  EXPECT_GT(overshoot(false), 1);
  EXPECT_LT(overshoot(true), 0.5 * overshoot(false));
  Pid pid({.gains = {.Kp = 1, .Ki = 1}, .lowest = -1, .highest = 1});
  for (int i = 0; i < 100; ++i) EXPECT_EQ(pid.step(10, 0, 0.1), 1);
  EXPECT_EQ(pid.integral(), 0);
  EXPECT_EQ(pid.step(-10, 0, 0.1), -1);
  EXPECT_EQ(pid.integral(), 0);
  EXPECT_EQ(pid.step(0.5, 0, 0.1), 0.5);
  EXPECT_DOUBLE_EQ(pid.integral(), 0.05);
}

// Stuck at a limit, an error that leads away from it still counts; also where Ki is negative.
TEST(Pid, LetsTheIntegralShrinkAtALimit) {
  Pid pid({.gains = {.Ki = 10, .Kd = 1}, .lowest = -1, .highest = 1});
  for (int i = 0; i < 2; ++i) static_cast<void>(pid.step(1, 0, 0.1));
  const double wound = pid.integral();
  EXPECT_EQ(pid.step(-1, 100, 0.1), 1);
  EXPECT_DOUBLE_EQ(pid.integral(), wound - 0.1);
  Pid reverse({.gains = {.Ki = -10, .Kd = 1}, .lowest = -1, .highest = 1});
  EXPECT_EQ(reverse.step(-1, 100, 0.1), 1);
  EXPECT_EQ(reverse.integral(), 0);
  EXPECT_EQ(reverse.step(1, 100, 0.1), 1);
  EXPECT_DOUBLE_EQ(reverse.integral(), 0.1);
}

TEST(Pid, TakesDifferencesOfTheError) {
  Pid pid({.gains = {.Kd = 1}});
  EXPECT_EQ(pid.step(3, 0.5), 0);
  EXPECT_DOUBLE_EQ(pid.step(4, 0.5), 2);
  EXPECT_DOUBLE_EQ(pid.step(4, 0.5), 0);
  pid.reset();
  EXPECT_EQ(pid.step(100, 0.5), 0);
}

// A ramp passes the filter as 1 - exp(-t / filterTime), and white noise is damped.
TEST(Pid, SmoothsDifferencesByAFilterOfFirstOrder) {
  const double h = 1e-4, filterTime = 0.2;
  Pid pid({.gains = {.Kd = 1}, .filterTime = filterTime});
  for (int i = 0; i <= 5000; ++i) {
    const double t = i * h;
    EXPECT_NEAR(pid.step(3 * t, h), 3 * (1 - std::exp(-t / filterTime)), 2e-3);
  }
  Rng rng(2);
  double plain = 0, smooth = 0;
  Pid sharp({.gains = {.Kd = 1}}), filtered({.gains = {.Kd = 1}, .filterTime = 0.05});
  for (int i = 0; i < 1000; ++i) {
    const double error = rng.normal();
    plain += std::pow(sharp.step(error, 0.01), 2);
    smooth += std::pow(filtered.step(error, 0.01), 2);
  }
  EXPECT_LT(smooth, 0.1 * plain);
}

TEST(Pid, RefusesBadNumbers) {
  const double nan = std::nan("");
  EXPECT_REX_ERROR(Pid({.gains = {.Kp = nan}}), "gain Kp: found nan, wanted a finite number");
  EXPECT_REX_ERROR(Pid({.gains = {.Ki = nan}}), "gain Ki: found nan");
  EXPECT_REX_ERROR(Pid({.gains = {.Kd = nan}}), "gain Kd: found nan");
  EXPECT_REX_ERROR(Pid({.lowest = 1, .highest = -1}),
                   "limits of u: found 1 to -1, wanted the lower one first");
  EXPECT_REX_ERROR(Pid({.filterTime = -1}), "filter time: found -1, wanted a finite number, 0 or more");
  Pid pid({.gains = {.Kp = 1, .Ki = 1}});
  EXPECT_REX_ERROR(pid.step(nan, 0, 1), "error: found nan");
  EXPECT_REX_ERROR(pid.step(1, nan, 1), "velocity error: found nan");
  EXPECT_REX_ERROR(pid.step(1, 1, 0), "time step h: found 0, wanted a positive, finite number");
  EXPECT_REX_ERROR(pid.step(nan, 1), "error: found nan");
  EXPECT_REX_ERROR(pid.step(1, -1), "time step h: found -1");
  EXPECT_EQ(pid.integral(), 0);
  EXPECT_REX_ERROR(pidIsStable(0, {}), "mass: found 0");
  EXPECT_REX_ERROR(pidIsStable(1, {.Kp = nan}), "gain Kp: found nan");
}

// The next step is the one that a controller takes which never saw the bad one.
TEST(Pid, StaysAsItWasWhenAStepFails) {
  const double huge = 1e308;
  const auto failsAlike = [](const PidOptions& options, double e, double h, const std::string& text) {
    Pid pid(options), other(options);
    for (Pid* one : {&pid, &other}) static_cast<void>(one->step(-1e307, 1));
    EXPECT_REX_ERROR(pid.step(e, h), text);
    EXPECT_EQ(pid.integral(), other.integral());
    EXPECT_EQ(pid.step(-1e306, 1), other.step(-1e306, 1));
    EXPECT_EQ(pid.integral(), other.integral());
  };
  failsAlike({.gains = {.Kd = 1}, .filterTime = 1e-3}, huge, 1e-3,
             "difference of the last two errors, per second: found inf, wanted a finite number");
  failsAlike({.gains = {.Kp = 10}}, huge, 1, "force u: found inf, wanted a finite number");
  failsAlike({.gains = {.Kp = 10, .Kd = -10}, .filterTime = 1}, huge, 1, "force u: found nan");
  failsAlike({.gains = {.Ki = 0.01}}, huge, 1e3, "integral of the error: found inf, wanted a finite number");
}

TEST(Pid, KeepsAForceWithinItsLimitsThatWouldOverflow) {
  Pid pid({.gains = {.Kp = 10}, .lowest = -5, .highest = 5});
  EXPECT_EQ(pid.step(1e308, 0, 1e-3), 5);
}

}  // namespace rex::pid_test
