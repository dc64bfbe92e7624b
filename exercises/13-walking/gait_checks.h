#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <stdexcept>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "course/linear_algebra.h"
#include "grading/check.h"
#include "grading/evidence.h"
#include "interface.h"
#include "locomotion/limit_cycle.h"

// Part 4: the grader's walkers, and what must hold for impacts, steps and gaits.

inline constexpr double kDegree = std::numbers::pi / 180;

inline rex::CompassGait libraryOf(const Walker& walker) {
  return {walker.a, walker.b, walker.legMass, walker.hipMass, walker.slope, walker.g};
}

inline std::string described(const Walker& walker) {
  return fmt::format("a {:.6g}, b {:.6g}, legs {:.6g}, hip {:.6g}, slope {:.6g} degrees, g {:.6g}", walker.a,
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

/// The gait of the paper, that of the default walker.
inline const Eigen::Vector4d kPaperGait(.218668802939, -.323388558059, -1.091826677490, -.377181558403);

/// The moduli of complex numbers, the largest first.
inline Eigen::VectorXd sizesOf(const Eigen::VectorXcd& numbers) {
  Eigen::VectorXd sizes = numbers.cwiseAbs();
  std::sort(sizes.begin(), sizes.end(), std::greater{});
  return sizes;
}

/// Continues the gait of the paper's walker to another shape and slope by small changes, then scales it to
/// another size: rates are proportional to sqrt(g / l).
inline KnownGait gaitOf(const Walker& goal) {
  constexpr int kChanges = 10;
  const Walker first;
  Eigen::Vector4d x = kPaperGait;
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
  check.shape("state after impactOf", after, 4, 1);
  check.near("angles after impactOf", after.head<2>(), Eigen::Vector2d(x[1], x[0]), 1e-12, "rad");
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
  const Eigen::Vector2d rates = rex::solve(ofRates, kept);
  const double size =
      (walker.hipMass + 2 * m) * std::pow(walker.a + walker.b, 2) * (x.tail<2>().norm() + rates.norm());
  const Eigen::Vector2d got = momenta(now);
  check.near("angular momentum about the foot that lands, after impactOf", got[0], kept[0], 1e-10 * size,
             "kg m^2/s");
  // The leg that stood before swings now.
  check.near("angular momentum of the leg behind about the hip, after impactOf", got[1], kept[1],
             1e-10 * size, "kg m^2/s");
}

/// The sum of the angles falls until both feet are on the slope.
inline rex::grading::Evidence landingSeen(const Walker& walker, const Eigen::Vector4d& x, double wanted,
                                          double got) {
  rex::Series sum{.label = "theta_s + theta_ns"};
  for (int i = 0; i < 200; ++i) {
    const double time = wanted * i / 200;
    sum.add(time, (i == 0 ? x : libraryOf(walker).step(x, time).before).head<2>().sum());
  }
  rex::Figure figure{.title = "Both feet are on the slope where the sum of the angles is -2 slope",
                     .xLabel = "time [s]",
                     .yLabel = "angle [rad]",
                     .series = {std::move(sum)}};
  figure.horizontalLines = {{.at = -2 * walker.slope, .label = "-2 slope"}};
  figure.verticalLines = {{.at = got, .label = "your step ends here", .color = rex::grading::kWrongColor},
                          {.at = wanted, .label = "wanted", .color = rex::grading::kWantedColor}};
  return {.figures = {std::move(figure)}};
}

/// If a step ends too early or at the end of a whole time step, the question about that.
inline std::string questionAboutLanding(const Walker& walker, const Eigen::Vector4d& x, double wanted,
                                        double got) {
  if (got > 0 && got < wanted - 1e-3) {
    const Eigen::Vector4d then = libraryOf(walker).step(x, got).before;
    if (then[1] <= then[0] + 1e-3)
      return "Does the step end where the swing foot is not in front, such as when the legs pass each other?";
  }
  for (const double h : {1e-2, 5e-3, 2e-3, 1e-3, 5e-4, 1e-4})
    if (std::abs(std::ceil(wanted / h) * h - got) < 1e-9)
      return "Does the step end at the end of a time step? The impact is within it.";
  return "";
}

inline constexpr rex::Color kSwingColor{.8f, .45f, 0};

/// A step as a curve of each leg, angle and rate, and where it ended beside where it should.
inline rex::grading::Evidence stepSeen(const Walker& walker, Eigen::Vector4d x, const rex::WalkerStep& wanted,
                                       const StepEnd& end) {
  const Eigen::Vector4d start = x;
  rex::Series legs[] = {{.label = "stance leg", .color = rex::grading::kGotColor},
                        {.label = "swing leg", .color = kSwingColor}};
  for (int i = 1; i <= 200; ++i) {
    for (int leg = 0; leg < 2; ++leg) legs[leg].add(x[leg], x[leg + 2]);
    const double time = wanted.time * i / 200;
    x = time < wanted.time ? libraryOf(walker).step(start, time).before : wanted.before;
  }
  rex::Figure figure{.title = "A step of the compass walker, and the state after its impact",
                     .xLabel = "angle [rad]",
                     .yLabel = "rate [rad/s]",
                     .legend = rex::Legend::kOutside,
                     .series = {legs[0], legs[1]}};
  const auto mark = [&](const std::string& label, const Eigen::Vector4d& state, int leg, rex::Marker marker) {
    figure.series.push_back(rex::dots(Eigen::Vector2d(state[leg], state[leg + 2]),
                                      {.label = label,
                                       .marker = marker,
                                       .size = 2,
                                       .color = leg == 0 ? rex::grading::kGotColor : kSwingColor}));
  };
  mark("stance leg, yours", end.x, 0, rex::Marker::kCircle);
  mark("swing leg, yours", end.x, 1, rex::Marker::kCircle);
  mark("stance leg, wanted", wanted.after, 0, rex::Marker::kCross);
  mark("swing leg, wanted", wanted.after, 1, rex::Marker::kCross);
  return {.figures = {std::move(figure)}};
}

/// A step that begins with the swing foot lifted by that angle: then the sum of the angles falls through its
/// value at once, while the foot is still behind.
inline void checkStep(rex::grading::Check& check, Student& student, const KnownGait& gait, double lift = 0) {
  Eigen::Vector4d x;
  rex::WalkerStep wanted;
  do {
    x = near(check.rng(), gait, .1) + Eigen::Vector4d(0, lift, 0, 0);
    wanted = libraryOf(gait.walker).step(x, 5);
  } while (wanted.status != rex::StepStatus::kStepped);
  check.input(described(gait.walker, x));
  const auto end = student.stepFrom(gait.walker, x);
  check.that("stepFrom() returns the end of the step", end.has_value());
  {
    const auto shown = check.show([&] { return landingSeen(gait.walker, x, wanted.time, end->time); });
    const auto when = check.ask(questionAboutLanding(gait.walker, x, wanted.time, end->time));
    check.near("time of stepFrom", end->time, wanted.time, 1e-7, "s");
  }
  const auto shown = check.show([&] { return stepSeen(gait.walker, x, wanted, *end); });
  check.near("state after stepFrom", end->x, wanted.after, 1e-7);
}

inline void doesNotStep(rex::grading::Check& check, Student& student, const Walker& walker,
                        const Eigen::Vector4d& x, const std::string& reason) {
  check.input(described(walker, x));
  check.that("stepFrom() returns nothing if " + reason, !student.stepFrom(walker, x).has_value());
}

inline void derivativeFits(rex::grading::Check& check, Student& student, const KnownGait& gait) {
  Eigen::Vector4d x;
  rex::WalkerStepJacobian wanted;
  do {
    x = near(check.rng(), gait, .03);
    wanted = libraryOf(gait.walker).stepJacobian(x, 5);
  } while (wanted.step.status != rex::StepStatus::kStepped);
  check.input(described(gait.walker, x));
  const Eigen::Matrix4d got = student.stepDerivative(gait.walker, x);
  check.shape("stepDerivative", got, 4, 4);
  const double size = wanted.J.cwiseAbs().maxCoeff();
  // What a later impact at the same state before it would change.
  const Eigen::Vector4d& landing = wanted.step.before;
  const Eigen::Vector4d drift =
      (libraryOf(gait.walker).impactJacobian(landing) * libraryOf(gait.walker).derivative(landing))
          .normalized();
  const Eigen::Matrix4d error = got - wanted.J;
  const bool isFixed = (error - drift * (drift.transpose() * error)).cwiseAbs().maxCoeff() < 1e-3 * size;
  const auto fixed = check.ask("Is the time of the step kept fixed? It depends on the start, too.", isFixed);
  check.near("stepDerivative", got, wanted.J, 1e-4 * size);
}

/// Too slow to get over the foot it stands on.
inline void hasNoGait(rex::grading::Check& check, Student& student, const Walker& walker) {
  Eigen::Vector4d guess;
  do {
    const double stance = check.rng().uniform(.15, .25);
    guess = {stance, -2 * walker.slope - stance, check.rng().uniform(-.5, .1), check.rng().uniform(-.5, -.2)};
  } while (libraryOf(walker).step(guess, 5).status != rex::StepStatus::kFellBackward);
  check.input(described(walker, guess));
  check.that("gaitNear() returns nothing if the walker falls", !student.gaitNear(walker, guess).has_value());
}

inline void gaitFits(rex::grading::Check& check, Student& student, const KnownGait& gait,
                     const Eigen::Vector4d& guess) {
  check.input(described(gait.walker, guess));
  const auto x = student.gaitNear(gait.walker, guess);
  check.that("gaitNear() finds the existing gait", x.has_value());
  check.shape("gait of gaitNear", *x, 4, 1);
  check.near("gait of gaitNear", *x, gait.x, 1e-4);
  const rex::WalkerStep step = libraryOf(gait.walker).step(*x, 5);
  check.that("the walker steps from the gait of gaitNear()", step.status == rex::StepStatus::kStepped);
  check.near("state one step after the gait of gaitNear", step.after, *x, 1e-6);
  // Gaits differ a little, and so do their multipliers.
  const Eigen::VectorXd got = student.multiplierSizes(gait.walker, *x);
  const Eigen::VectorXd ofRate = sizesOf(rex::eigenvalues(libraryOf(gait.walker).derivativeJacobian(*x)));
  const auto swing = check.ask("Are these eigenvalues of swingRate()? Wanted are those of stepDerivative().",
                               got.size() == 4 && (got - ofRate).cwiseAbs().maxCoeff() < .01);
  check.near("multiplierSizes", got, sizesOf(gait.cycle.multipliers), .01);
}
