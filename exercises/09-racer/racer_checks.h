#pragma once

#include <algorithm>
#include <cmath>
#include <string>

#include <fmt/format.h>

#include "control/regulators.h"
#include "grading/check.h"
#include "interface.h"
#include "systems/racer.h"

// Parts 1 to 3 without noise: the motion of a racer and its regulator, against the library's.

inline rex::RacerDynamics dynamicsOf(const RacerModel& racer) {
  return {racer.r, racer.l, racer.mA, racer.mB, racer.IA, racer.IB, racer.g};
}

inline Eigen::Vector4d stateOf(const Eigen::Vector2d& q, const Eigen::Vector2d& v) {
  return {q[0], q[1], v[0], v[1]};
}

/// Inertias from those of a ring and a rod down to those of discs and lumps.
inline RacerModel randomRacer(rex::Rng& rng) {
  RacerModel racer{.r = rng.uniform(.04, .1), .l = rng.uniform(.4, .8)};
  racer.mA = rng.uniform(.03, .2);
  racer.mB = rng.uniform(.3, 1);
  racer.IA = rng.uniform(.25, 1) * racer.mA * racer.r * racer.r;
  racer.IB = rng.uniform(.04, .3) * racer.mB * racer.l * racer.l;
  racer.g = rng.uniform(6, 11);
  return racer;
}

inline std::string described(const RacerModel& racer) {
  return fmt::format("r = {:.6g}, l = {:.6g}, mA = {:.6g}, mB = {:.6g}, IA = {:.6g}, IB = {:.6g}, g = {:.6g}",
                     racer.r, racer.l, racer.mA, racer.mB, racer.IA, racer.IB, racer.g);
}

inline Eigen::Vector4d randomState(rex::Rng& rng) {
  return stateOf(2 * rng.normalVector(2), 3 * rng.normalVector(2));
}

inline void massFits(rex::grading::Check& check, Student& student, const RacerModel& racer) {
  const rex::RacerDynamics plant = dynamicsOf(racer);
  for (int i = 0; i < 10; ++i) {
    const Eigen::Vector4d x = randomState(check.rng());
    check.input(described(racer), {{"q", x.head<2>()}, {"q'", x.tail<2>()}});
    const Eigen::Matrix2d M = plant.massMatrix(x.head<2>());
    const Eigen::Matrix2d rolling = Eigen::Vector2d(racer.IA / (racer.r * racer.r), 0).asDiagonal(),
                          tilting = Eigen::Vector2d(0, racer.IB).asDiagonal();
    const auto wheel =
        check.suspect("Is the rotation of the wheel left out? It turns by x / r.", M - rolling);
    const auto disc = check.suspect(
        "Is the wheel taken for a disc? Its moment of inertia is IA.",
        M + Eigen::Matrix2d(Eigen::Vector2d(racer.mA / 2 - racer.IA / (racer.r * racer.r), 0).asDiagonal()));
    const auto pendulum =
        check.suspect("Is the rotation of the pendulum about its centre of mass left out?", M - tilting);
    check.near("M of massMatrix", student.massMatrix(x.head<2>(), racer), M, 1e-12);
    const double potential = plant.energy(stateOf(x.head<2>(), {0, 0})),
                 kinetic = plant.energy(x) - potential;
    check.near("energy of energyOf", student.energyOf(x, racer), plant.energy(x), 1e-11,
               {{"Is it T - U? The energy is T + U.", kinetic - potential},
                {"Is the potential energy zero on the axle? It is zero on the ground.",
                 plant.energy(x) - racer.g * racer.r * (racer.mA + racer.mB)},
                {"Is the kinetic energy twice too large?", plant.energy(x) + kinetic}},
               "J");
  }
}

inline void directionFits(rex::grading::Check& check, Student& student, const RacerModel& racer) {
  check.input(described(racer));
  check.near(
      "B of controlDirection", student.controlDirection(racer), dynamicsOf(racer).controlDirection(), 1e-12,
      {{"Does u turn the pendulum forwards? It turns the wheel forwards.", Eigen::Vector2d(1 / racer.r, 1)},
       {"Is 1 / r missing? u is a torque, and x a length.", Eigen::Vector2d(1, -1)}});
}

inline void forcesFit(rex::grading::Check& check, Student& student, const RacerModel& racer) {
  directionFits(check, student, racer);
  for (int i = 0; i < 10; ++i) {
    const Eigen::Vector4d x = randomState(check.rng());
    check.input(described(racer), {{"q", x.head<2>()}, {"q'", x.tail<2>()}});
    const double s = racer.mB * racer.l * std::sin(x[1]), turning = s * x[3] * x[3], mixed = s * x[2] * x[3];
    const double fall = s * racer.g;
    check.near("F of forceTerm", student.forceTerm(x.head<2>(), x.tail<2>(), racer),
               dynamicsOf(racer).forces(x.head<2>(), x.tail<2>()), 1e-8 * (1 + x.squaredNorm()),
               {{"Is dT/dq left out?", Eigen::Vector2d(-turning, -mixed - fall)},
                {"Is dM/dt q' left out? d/dt dT/dq' is more than M q''.", Eigen::Vector2d(0, mixed - fall)},
                {"Is gravity left out?", Eigen::Vector2d(-turning, 0)}});
  }
}

inline void rateFits(rex::grading::Check& check, Student& student, const RacerModel& racer,
                     const Eigen::Vector4d& x, double u) {
  const rex::RacerDynamics plant = dynamicsOf(racer);
  const Eigen::Vector2d F = plant.forces(x.head<2>(), x.tail<2>()), push = plant.controlDirection() * u;
  const Eigen::Matrix2d inverse = plant.massMatrix(x.head<2>()).inverse();
  const Eigen::Vector4d wanted = plant.derivative(x, u);
  check.near("dx/dt of rateOf", student.rateOf(x, u, racer), wanted, 1e-7 * (1 + wanted.norm()),
             {{"Is F added to B u? In M q'' + F = B u it is on the other side.",
               stateOf(x.tail<2>(), inverse * (push + F))},
              {"Is u left out?", stateOf(x.tail<2>(), inverse * -F)},
              {"Is the inverse of M left out?", stateOf(x.tail<2>(), push - F)}});
}

/// Exact up to what F by finite differences loses: the error of the method itself is a hundred times as
/// large.
inline void checkStep(rex::grading::Check& check, Student& student, const RacerModel& racer, double tau) {
  const rex::RacerDynamics plant = dynamicsOf(racer);
  for (int i = 0; i < 10; ++i) {
    const Eigen::Vector4d x = randomState(check.rng());
    const double u = check.rng().normal();
    check.input(described(racer), {{"x", x}, {"u", u}, {"tau", tau}});
    rateFits(check, student, racer, x, u);
    const Eigen::Vector4d rate = plant.derivative(x, u);
    check.near("state after a step of stepped", student.stepped(x, u, tau, racer),
               plant.rungeKuttaStep(x, u, tau), 1e-9 * (1 + tau * rate.norm()),
               {{"Is it one step of the midpoint method, which takes only the second of the four rates?",
                 x + tau * plant.derivative(x + tau / 2 * rate, u)},
                {"Is the step kTau long, whatever tau is?", plant.rungeKuttaStep(x, u, kTau)}});
  }
}

inline rex::LinearizedPlant nearRest(const RacerModel& racer) {
  return dynamicsOf(racer).linearized(Eigen::Vector4d::Zero(), 0);
}

inline void linearFits(rex::grading::Check& check, Student& student, const RacerModel& racer) {
  check.input(described(racer));
  const rex::LinearizedPlant exact = nearRest(racer);
  Eigen::Matrix4d M = Eigen::Matrix4d::Identity();
  M.bottomRightCorner<2, 2>() = dynamicsOf(racer).massMatrix({0, 0});
  const auto massOfA = check.suspect("Is the inverse of M left out?", M * exact.A);
  const auto massOfB = check.suspect("Is the inverse of M left out?", M * exact.B);
  const Linear got = student.linearNearRest(racer);
  check.near("A of linearNearRest", got.A, exact.A, 2e-6 * exact.A.cwiseAbs().maxCoeff());
  check.near("B of linearNearRest", got.B, exact.B, 2e-6 * exact.B.cwiseAbs().maxCoeff());
}

inline Eigen::Vector4d bestGain(const RacerModel& racer, const Eigen::Matrix4d& Q, double R) {
  const rex::LinearizedPlant plant = nearRest(racer);
  return rex::lqr({.A = plant.A, .B = plant.B}, Q, Eigen::Matrix<double, 1, 1>(R)).K.transpose();
}

inline void gainFits(rex::grading::Check& check, Student& student, const RacerModel& racer,
                     const Eigen::Vector2d& costs, double R) {
  const rex::LinearizedPlant plant = nearRest(racer);
  const Eigen::Matrix4d Q = Eigen::Vector4d(costs[0], costs[1], 0, 0).asDiagonal();
  check.input("a racer near rest and its costs", {{"A", plant.A}, {"B", plant.B}, {"Q", Q}, {"R", R}});
  const Eigen::Vector4d exact = bestGain(racer, Q, R);
  check.near("K of lqrGain", student.lqrGain({plant.A, plant.B}, Q, R), exact,
             2e-6 * exact.cwiseAbs().maxCoeff(), {{"Is B^T P not divided by R?", R * exact}});
}

/// The racer stays up for 20 s with noise, under the student's linearisation and gain.
inline void gainHolds(rex::grading::Check& check, Student& student, const RacerModel& racer) {
  const rex::RacerDynamics plant = dynamicsOf(racer);
  const Eigen::Matrix4d Q = Eigen::Vector4d(1, 10, 0, 0).asDiagonal();
  const Eigen::Vector4d K = student.lqrGain(student.linearNearRest(racer), Q, 1);
  check.shape("K of lqrGain", K, 4, 1);
  for (const double tilt : {-.2, .2}) {
    Eigen::Vector4d x(0, tilt, 0, 0);
    rex::grading::Signal angle{.axis = "time [s]"};
    for (int t = 0; t < 2000 && std::abs(x[1]) <= kLargestAngle; ++t) {
      const double u = std::clamp(-K.dot(x), -kLargestControl, kLargestControl);
      x = plant.noisyStep(x, u, kTau, kNoise, check.rng());
      angle.add(kTau * (t + 1), std::abs(x[1]));
    }
    check.atMostAlong("|theta| under u = -K x, with noise", angle, kLargestAngle, "rad");
  }
}
