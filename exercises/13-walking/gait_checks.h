#pragma once

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "course/linear_algebra.h"
#include "grading/check.h"
#include "grading/evidence_parts.h"
#include "interface.h"
#include "locomotion/limit_cycle.h"

// Part 4: the grader's walkers, and what must hold for impacts, steps and gaits.

inline constexpr double kDegree = std::numbers::pi / 180;

inline rex::CompassGait libraryOf(const Walker& walker) {
  return {walker.a, walker.b, walker.legMass, walker.hipMass, walker.slope, walker.g};
}

inline std::string described(const Walker& walker) {
  return fmt::format("a {:.4g}, b {:.4g}, legs {:.4g}, hip {:.4g}, slope {:.4g} degrees, g {:.4g}", walker.a,
                     walker.b, walker.legMass, walker.hipMass, walker.slope / kDegree, walker.g);
}

inline std::string described(const Walker& walker, const Eigen::Vector4d& x) {
  return fmt::format("{}, x = ({:.9g}, {:.9g}, {:.9g}, {:.9g})", described(walker), x[0], x[1], x[2], x[3]);
}

/// A walker and its gait.
struct KnownGait {
  Walker walker;
  Eigen::Vector4d x = Eigen::Vector4d::Zero();
  rex::LimitCycle cycle{};
};

/// Continues the gait of the paper's walker to another shape and slope by small changes, then scales it to
/// another size: rates are proportional to sqrt(g / l).
inline KnownGait gaitOf(const Walker& goal) {
  constexpr int kChanges = 10;
  const Walker first;
  Eigen::Vector4d x(.218668802939, -.323388558059, -1.091826677490, -.377181558403);
  const double l = goal.a + goal.b;
  for (int i = 1; i <= kChanges; ++i) {
    const double s = 1. * i / kChanges;
    Walker at = first;
    at.a += s * (goal.a / l - at.a);
    at.b = 1 - at.a;
    at.hipMass += s * (goal.hipMass / goal.legMass * at.legMass - at.hipMass);
    at.slope += s * (goal.slope - at.slope);
    const rex::LimitCycle cycle = rex::findLimitCycle(libraryOf(at), x);
    if (cycle.status != rex::LimitCycle::Status::kFound) throw std::logic_error("no gait: " + cycle.message);
    x = cycle.x;
  }
  x.tail<2>() *= std::sqrt(goal.g / 9.8 / l);
  const rex::LimitCycle cycle = rex::findLimitCycle(libraryOf(goal), x);
  if (cycle.status != rex::LimitCycle::Status::kFound) throw std::logic_error("no gait: " + cycle.message);
  return {goal, cycle.x, cycle};
}

inline Walker randomWalker(rex::Rng& rng) {
  const double l = rng.uniform(.5, 1.5), share = rng.uniform(.45, .55), mass = rng.uniform(1, 8);
  return {.a = share * l,
          .b = (1 - share) * l,
          .legMass = mass,
          .hipMass = rng.uniform(1.5, 3) * mass,
          .slope = rng.uniform(2, 3.7) * kDegree,
          .g = rng.uniform(2, 12)};
}

/// A state that is not far from a gait: both feet on the slope, angles and rates a few per cent off.
inline Eigen::Vector4d near(rex::Rng& rng, const KnownGait& gait, double share) {
  const double turn = share * rng.uniform(-.2, .2);
  Eigen::Vector4d x = gait.x + Eigen::Vector4d(turn, -turn, 0, 0);
  for (int i : {2, 3}) x[i] *= 1 + share * rng.uniform(-1, 1);
  return x;
}

/// The three masses as points: positions relative to the stance foot, and velocities.
struct LegMasses {
  Eigen::Vector2d hip, stance, swing, foot, hipRate, stanceRate, swingRate;
};

inline LegMasses massesOf(const Walker& w, const Eigen::Vector4d& x) {
  const auto up = [](double angle) { return Eigen::Vector2d(-std::sin(angle), std::cos(angle)); };
  const auto turned = [](double angle) { return Eigen::Vector2d(-std::cos(angle), -std::sin(angle)); };
  const double l = w.a + w.b;
  LegMasses at;
  at.hip = l * up(x[0]);
  at.stance = w.a * up(x[0]);
  at.swing = at.hip - w.b * up(x[1]);
  at.foot = at.hip - l * up(x[1]);
  at.hipRate = l * x[2] * turned(x[0]);
  at.stanceRate = w.a * x[2] * turned(x[0]);
  at.swingRate = at.hipRate - w.b * x[3] * turned(x[1]);
  return at;
}

inline double planarCross(const Eigen::Vector2d& p, const Eigen::Vector2d& v) {
  return p.x() * v.y() - p.y() * v.x();
}

inline void impactFits(rex::grading::Check& check, Student& student, const Walker& walker) {
  rex::Rng& rng = check.rng();
  const double stance = rng.uniform(-.5, -.1) - walker.slope;
  const Eigen::Vector4d x(stance, -2 * walker.slope - stance, 2 * rng.normal(), 2 * rng.normal());
  check.input(described(walker, x));
  const Eigen::Vector4d after = student.impactOf(walker, x);
  check.near("angles after the impact", after.head<2>(), Eigen::Vector2d(x[1], x[0]), 1e-12, "rad");
  check.shape("state after the impact", after, 4, 1);
  const LegMasses old = massesOf(walker, x), now = massesOf(walker, after);
  const double m = walker.legMass;
  const double before = walker.hipMass * planarCross(old.hip - old.foot, old.hipRate) +
                        m * planarCross(old.stance - old.foot, old.stanceRate) +
                        m * planarCross(old.swing - old.foot, old.swingRate);
  // Both momenta are linear in the rates after the impact, so they determine the wanted ones and their
  // size.
  const auto momenta = [&](const LegMasses& legs) {
    return Eigen::Vector2d(walker.hipMass * planarCross(legs.hip, legs.hipRate) +
                               m * planarCross(legs.stance, legs.stanceRate) +
                               m * planarCross(legs.swing, legs.swingRate),
                           m * planarCross(legs.swing - legs.hip, legs.swingRate));
  };
  Eigen::Matrix2d ofRates;
  for (int k = 0; k < 2; ++k)
    ofRates.col(k) = momenta(massesOf(walker, Eigen::Vector4d(x[1], x[0], k == 0 ? 1 : 0, k)));
  const Eigen::Vector2d kept(before, m * planarCross(old.stance - old.hip, old.stanceRate));
  const double size = (walker.hipMass + 2 * m) * std::pow(walker.a + walker.b, 2) *
                      (x.tail<2>().norm() + rex::solve(ofRates, kept).norm());
  const Eigen::Vector2d got = momenta(now);
  check.near("angular momentum of all masses about the foot that lands", got[0], kept[0], 1e-10 * size,
             "kg m^2/s");
  // The leg that stood before swings now.
  check.near("angular momentum of the leg behind about the hip", got[1], kept[1], 1e-10 * size, "kg m^2/s");
}

/// A step as a curve of each leg, angle and rate, and where it ended beside where it should.
inline rex::grading::Evidence stepSeen(const Walker& walker, Eigen::Vector4d x, const rex::WalkerStep& wanted,
                                       const StepEnd& end) {
  const Eigen::Vector4d start = x;
  rex::Series legs[] = {{.label = "stance leg"}, {.label = "swing leg"}};
  for (int i = 1; i <= 200; ++i) {
    for (int leg = 0; leg < 2; ++leg) {
      legs[leg].x.push_back(x[leg]);
      legs[leg].y.push_back(x[leg + 2]);
    }
    const double time = wanted.time * i / 200;
    x = time < wanted.time ? libraryOf(walker).step(start, time).before : wanted.before;
  }
  rex::Series right = rex::grading::wantedCurve("wanted after the impact", {wanted.after[0], wanted.after[1]},
                                                {wanted.after[2], wanted.after[3]});
  rex::Series got = rex::grading::gotCurve("yours", {end.x[0], end.x[1]}, {end.x[2], end.x[3]});
  got.style = right.style = rex::SeriesStyle::kPoints;
  got.marker = rex::Marker::kCircle;
  right.marker = rex::Marker::kCross;
  right.size = 2;
  return {.figures = {{.title = "A step of the compass walker",
                       .xLabel = "angle [rad]",
                       .yLabel = "rate [rad/s]",
                       .legend = rex::Legend::kOutside,
                       .series = {legs[0], legs[1], got, right}}}};
}

inline void stepFits(rex::grading::Check& check, Student& student, const KnownGait& gait) {
  Eigen::Vector4d x;
  rex::WalkerStep wanted;
  do {
    x = near(check.rng(), gait, .1);
    wanted = libraryOf(gait.walker).step(x, 5);
  } while (wanted.status != rex::StepStatus::kStepped);
  check.input(described(gait.walker, x));
  const auto end = student.stepFrom(gait.walker, x);
  check.that("the walker steps", end.has_value());
  const auto shown = check.show([&] { return stepSeen(gait.walker, x, wanted, *end); });
  check.near("time of the step", end->time, wanted.time, 1e-7, "s");
  check.near("state after the step", end->x, wanted.after, 1e-7);
}

inline void doesNotStep(rex::grading::Check& check, Student& student, const Walker& walker,
                        const Eigen::Vector4d& x) {
  check.input(described(walker, x));
  check.that("a walker that falls makes no step", !student.stepFrom(walker, x).has_value());
}

inline void derivativeFits(rex::grading::Check& check, Student& student, const KnownGait& gait) {
  Eigen::Vector4d x;
  rex::WalkerStepJacobian wanted;
  do {
    x = near(check.rng(), gait, .03);
    wanted = libraryOf(gait.walker).stepJacobian(x, 5);
  } while (wanted.step.status != rex::StepStatus::kStepped);
  check.input(described(gait.walker, x));
  check.near("derivative of the step", student.stepDerivative(gait.walker, x), wanted.J,
             1e-4 * wanted.J.cwiseAbs().maxCoeff());
}

/// Too slow to get over the foot it stands on.
inline void hasNoGait(rex::grading::Check& check, Student& student, const Walker& walker) {
  Eigen::Vector4d guess;
  do {
    const double stance = check.rng().uniform(.15, .25);
    guess = {stance, -2 * walker.slope - stance, check.rng().uniform(-.5, .1), check.rng().uniform(-.5, -.2)};
  } while (libraryOf(walker).step(guess, 5).status != rex::StepStatus::kFellBackward);
  check.input(described(walker, guess));
  check.that("no gait is returned if the walker falls", !student.gaitNear(walker, guess).has_value());
}

inline void gaitFits(rex::grading::Check& check, Student& student, const KnownGait& gait,
                     const Eigen::Vector4d& guess) {
  check.input(described(gait.walker, guess));
  const auto x = student.gaitNear(gait.walker, guess);
  check.that("gaitNear() finds the existing gait", x.has_value());
  check.shape("gait", *x, 4, 1);
  const rex::WalkerStep step = libraryOf(gait.walker).step(*x, 5);
  check.that("from the state of the gait, the walker steps", step.status == rex::StepStatus::kStepped);
  check.near("change of the state by one step of the gait", step.after - *x, Eigen::Vector4d::Zero(), 1e-6);
  // A change of 1e-6 in a step may mean one of 1e-4 in the gait if a multiplier is near one.
  check.near("state of the gait", *x, gait.x, 1e-4);
  check.near("moduli of the multipliers", student.multiplierSizes(gait.walker, *x),
             gait.cycle.multipliers.cwiseAbs(), .01);
}
