#pragma once

#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "grading/check.h"
#include "interface.h"
#include "locomotion/zero_moment_point.h"
#include "support_checks.h"

// Part 2: the zero moment point by its definition, and the motions of the pendulum.

inline Eigen::Vector2d zeroMomentOf(const std::vector<MovingMass>& robot, double groundHeight, double g) {
  Eigen::Vector2d moments = Eigen::Vector2d::Zero();
  double down = 0;
  for (const auto& [mass, p, a] : robot) {
    const double weight = mass * (a.z() + g);
    moments += weight * p.head<2>() - (p.z() - groundHeight) * mass * a.head<2>();
    down += weight;
  }
  return moments / down;
}

/// The sum of the vertical forces m (a + g).
inline double pushOf(const std::vector<MovingMass>& robot, double g) {
  double push = 0;
  for (const MovingMass& one : robot) push += one.mass * (one.a.z() + g);
  return push;
}

inline void hasNoMoment(rex::grading::Check& check, Student& student, const std::vector<MovingMass>& robot,
                        double groundHeight, double g) {
  describe(check, fmt::format("a moving robot, ground at z = {:.6g}", groundHeight), robot, {"g", g});
  const auto zmp = student.zeroMoment(robot, groundHeight, g);
  check.that("zeroMoment() returns a point if the ground pushes", zmp.has_value());
  check.shape("zero moment point", *zmp, 2, 1);
  double size = 0;
  for (const MovingMass& part : robot) size += part.mass * (part.a.norm() + g) * (1 + part.p.norm());
  check.near("zeroMoment", *zmp, zeroMomentOf(robot, groundHeight, g), 1e-9 * size / pushOf(robot, g), "m");
}

/// Masses that press on the ground with a tenth of their weight at least.
inline std::vector<MovingMass> pressing(rex::Rng& rng, double g) {
  for (;;) {
    std::vector<MovingMass> robot = randomRobot(rng, rng.uniformVector(2, -1, 1), 6);
    if (pushOf(robot, g) > .1 * pushOf(robot, 2 * g)) return robot;
  }
}

inline void fallingHasNone(rex::grading::Check& check, Student& student, double g) {
  std::vector<MovingMass> robot = randomRobot(check.rng(), Eigen::Vector2d::Zero(), 1);
  for (MovingMass& part : robot) part.a.z() = -1.2 * g;
  describe(check, "all masses are pulled down, faster than they would fall", robot, {"g", g});
  check.that("zeroMoment() returns nothing if the ground would have to pull",
             !student.zeroMoment(robot, 0, g).has_value());
}

inline Pendulum randomPendulum(rex::Rng& rng) { return {rng.uniform(.3, 1.2), rng.uniform(2, 12)}; }
inline rex::InvertedPendulum libraryOf(const Pendulum& pendulum) { return {pendulum.height, pendulum.g}; }
inline Sway randomSway(rex::Rng& rng) { return {.2 * rng.normalVector(2), rng.normalVector(2)}; }

inline void swaysRight(rex::grading::Check& check, Student& student) {
  rex::Rng& rng = check.rng();
  const Pendulum pendulum = randomPendulum(rng);
  const Sway start = randomSway(rng);
  const Eigen::Vector2d p = .2 * rng.normalVector(2);
  const double omega = libraryOf(pendulum).omega(), t = rng.uniform(0, 4) / omega;
  check.input(
      "a pendulum",
      {{"height", pendulum.height}, {"g", pendulum.g}, {"c", start.c}, {"v", start.v}, {"p", p}, {"t", t}});
  const rex::CenterMotion wanted = libraryOf(pendulum).after({start.c, start.v}, p, t);
  const Sway got = student.swayed(pendulum, start, p, t);
  const double size = (start.c.norm() + p.norm() + start.v.norm() / omega) * std::exp(omega * t);
  check.near("position c of swayed", got.c, wanted.c, 1e-10 * size, "m");
  check.near("velocity v of swayed", got.v, wanted.v, 1e-10 * size * omega, "m/s");
}

/// The pendulum over a point, beside how it comes to rest over the capture point, along the axis where they
/// differ more.
inline rex::grading::Evidence captureSeen(const rex::InvertedPendulum& pendulum, const rex::CenterMotion& now,
                                          const Eigen::Vector2d& p) {
  const Eigen::Vector2d right = pendulum.capturePoint(now);
  Eigen::Index axis = 0;
  (p - right).cwiseAbs().maxCoeff(&axis);
  rex::Series got = rex::grading::gotCurve("over your point"), wanted = rex::grading::wantedCurve("wanted");
  for (int i = 0; i <= 40; ++i) {
    const double t = .05 * i / pendulum.omega();
    got.add(t, pendulum.after(now, p, t).c[axis]);
    wanted.add(t, pendulum.after(now, right, t).c[axis]);
  }
  rex::Figure figure{.title = "The centre of mass, while the zero moment point stays at the capture point",
                     .xLabel = "time [s]",
                     .yLabel = axis == 0 ? "x [m]" : "y [m]",
                     .series = {got, wanted}};
  figure.horizontalLines = {{.at = p[axis], .label = "your capture point", .color = rex::grading::kGotColor},
                            {.at = right[axis], .label = "wanted", .color = rex::grading::kWantedColor}};
  return {.figures = {std::move(figure)}};
}

inline void capturesTheMotion(rex::grading::Check& check, Student& student) {
  const Pendulum pendulum = randomPendulum(check.rng());
  const Sway now = randomSway(check.rng());
  check.input("a pendulum", {{"height", pendulum.height}, {"g", pendulum.g}, {"c", now.c}, {"v", now.v}});
  const Eigen::Vector2d p = student.capturePoint(pendulum, now);
  check.shape("capture point", p, 2, 1);
  const rex::InvertedPendulum library = libraryOf(pendulum);
  const auto shown = check.show([&] { return captureSeen(library, {now.c, now.v}, p); });
  check.near("capturePoint", p, library.capturePoint({now.c, now.v}), 1e-9, "m");
}
