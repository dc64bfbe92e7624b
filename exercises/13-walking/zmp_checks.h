#pragma once

#include <cmath>
#include <string>
#include <vector>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "grading/check.h"
#include "interface.h"
#include "locomotion/inverted_pendulum.h"
#include "support_checks.h"

// Part 2: the zero moment point by its definition, and the motions of the pendulum.

/// The sum of all forces m (a - gravity), and the sum of their moments about a point.
struct ForceAndMoment {
  Eigen::Vector3d force = Eigen::Vector3d::Zero(), moment = Eigen::Vector3d::Zero();
};

inline ForceAndMoment inertialForce(const std::vector<MovingMass>& robot, const Eigen::Vector3d& about,
                                    double g) {
  ForceAndMoment sum;
  for (const MovingMass& one : robot) {
    const Eigen::Vector3d force = one.mass * (one.a - Eigen::Vector3d(0, 0, -g));
    sum.force += force;
    sum.moment += (one.p - about).cross(force);
  }
  return sum;
}

inline void hasNoMoment(rex::grading::Check& check, Student& student, const std::vector<MovingMass>& robot,
                        double groundHeight, double g) {
  check.input(fmt::format("{} masses, the ground at {:.3g} m, g = {:.3g}", robot.size(), groundHeight, g));
  const auto zmp = student.zeroMoment(robot, groundHeight, g);
  check.that("zeroMoment() returns a point if the ground pushes", zmp.has_value());
  check.shape("zero moment point", *zmp, 2, 1);
  const ForceAndMoment sum = inertialForce(robot, {zmp->x(), zmp->y(), groundHeight}, g);
  double size = 0;
  for (const MovingMass& part : robot) size += part.mass * (part.a.norm() + g) * (1 + part.p.norm());
  check.near("moment about it along x and y", sum.moment.head<2>(), Eigen::Vector2d::Zero(), 1e-9 * size,
             "N m");
}

/// Masses that press on the ground with a tenth of their weight at least.
inline std::vector<MovingMass> pressing(rex::Rng& rng, double g) {
  for (;;) {
    std::vector<MovingMass> robot = randomRobot(rng, rng.uniformVector(2, -1, 1), 6);
    const double push = inertialForce(robot, Eigen::Vector3d::Zero(), g).force.z();
    if (push > .1 * inertialForce(robot, Eigen::Vector3d::Zero(), 2 * g).force.z()) return robot;
  }
}

inline void fallingHasNone(rex::grading::Check& check, Student& student, double g) {
  std::vector<MovingMass> robot = randomRobot(check.rng(), Eigen::Vector2d::Zero(), 1);
  for (MovingMass& part : robot) part.a.z() = -1.2 * g;
  check.input("all masses are pulled down, faster than they would fall");
  check.that("no zero moment point is returned if the ground would have to pull",
             !student.zeroMoment(robot, 0, g).has_value());
}

inline Pendulum randomPendulum(rex::Rng& rng) { return {rng.uniform(.3, 1.2), rng.uniform(2, 12)}; }
inline rex::InvertedPendulum libraryOf(const Pendulum& pendulum) { return {pendulum.height, pendulum.g}; }
inline Sway randomSway(rex::Rng& rng) { return {.2 * rng.normalVector(2), rng.normalVector(2)}; }

inline std::string described(const Pendulum& pendulum, const Sway& at) {
  return fmt::format("height {:.4g}, g {:.4g}, c = ({:.4g}, {:.4g}), v = ({:.4g}, {:.4g})", pendulum.height,
                     pendulum.g, at.c.x(), at.c.y(), at.v.x(), at.v.y());
}

inline void swaysRight(rex::grading::Check& check, Student& student) {
  rex::Rng& rng = check.rng();
  const Pendulum pendulum = randomPendulum(rng);
  const Sway start = randomSway(rng);
  const Eigen::Vector2d p = .2 * rng.normalVector(2);
  const double omega = libraryOf(pendulum).omega(), t = rng.uniform(0, 4) / omega;
  check.input(
      fmt::format("{}, p = ({:.4g}, {:.4g}), t = {:.4g}", described(pendulum, start), p.x(), p.y(), t));
  const rex::CenterMotion wanted = libraryOf(pendulum).after({start.c, start.v}, p, t);
  const Sway got = student.swayed(pendulum, start, p, t);
  const double size = (start.c.norm() + p.norm() + start.v.norm() / omega) * std::exp(omega * t);
  check.near("position of the centre of mass", got.c, wanted.c, 1e-10 * size, "m");
  check.near("its velocity", got.v, wanted.v, 1e-10 * size * omega, "m/s");
}

/// The pendulum over a point, x over time, beside how it comes to rest over the capture point.
inline rex::grading::Evidence captureSeen(const rex::InvertedPendulum& pendulum, const rex::CenterMotion& now,
                                          const Eigen::Vector2d& p) {
  rex::Series got = rex::grading::gotCurve("over your point"), wanted = rex::grading::wantedCurve("wanted");
  for (int i = 0; i <= 40; ++i) {
    const double t = .05 * i / pendulum.omega();
    got.x.push_back(t);
    got.y.push_back(pendulum.after(now, p, t).c.x());
    wanted.x.push_back(t);
    wanted.y.push_back(pendulum.after(now, pendulum.capturePoint(now), t).c.x());
  }
  return {.figures = {{.title = "The centre of mass, while the zero moment point stays where you put it",
                       .xLabel = "time [s]",
                       .yLabel = "x [m]",
                       .series = {got, wanted}}}};
}

/// Tests the purpose of the capture point: over it, the motion dies out. The growing mode grows by e^5 in
/// this time.
inline void capturesTheMotion(rex::grading::Check& check, Student& student) {
  const Pendulum pendulum = randomPendulum(check.rng());
  const Sway now = randomSway(check.rng());
  check.input(described(pendulum, now));
  const Eigen::Vector2d p = student.capturePoint(pendulum, now);
  check.shape("capture point", p, 2, 1);
  const double time = 5 / libraryOf(pendulum).omega();
  const rex::CenterMotion later = libraryOf(pendulum).after({now.c, now.v}, p, time);
  const auto shown = check.show([&] { return captureSeen(libraryOf(pendulum), {now.c, now.v}, p); });
  check.near("distance from the capture point after 5 / omega s", later.c - p, std::exp(-5) * (now.c - p),
             1e-7, "m");
}
