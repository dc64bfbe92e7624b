#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <string>

#include <fmt/format.h>

#include "control/racer_dynamics.h"
#include "control/regulators.h"
#include "grading/check.h"
#include "grading/evidence_parts.h"
#include "interface.h"
#include "render/figure_builders.h"

// Parts 1 to 3: the motion of a racer and its regulator, against the library's.

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
  return fmt::format("r {:.4g}, l {:.4g}, mA {:.4g}, mB {:.4g}, IA {:.4g}, IB {:.4g}, g {:.4g}", racer.r,
                     racer.l, racer.mA, racer.mB, racer.IA, racer.IB, racer.g);
}

inline std::string described(const RacerModel& racer, const Eigen::Vector4d& x) {
  return fmt::format("state ({:.4g}, {:.4g}, {:.4g}, {:.4g}), {}", x[0], x[1], x[2], x[3], described(racer));
}

inline Eigen::Vector4d randomState(rex::Rng& rng) {
  return stateOf(2 * rng.normalVector(2), 3 * rng.normalVector(2));
}

inline void massFits(rex::grading::Check& check, Student& student, const RacerModel& racer) {
  for (int i = 0; i < 10; ++i) {
    const Eigen::Vector4d x = randomState(check.rng());
    check.input(described(racer, x));
    const rex::RacerDynamics plant = dynamicsOf(racer);
    check.near("M", student.massMatrix(x.head<2>(), racer), plant.massMatrix(x.head<2>()), 1e-12);
    check.near("energy", student.energyOf(x, racer), plant.energy(x), 1e-11, "J");
  }
}

inline void forcesFit(rex::grading::Check& check, Student& student, const RacerModel& racer) {
  const rex::RacerDynamics plant = dynamicsOf(racer);
  check.input(described(racer));
  check.near("B", student.controlDirection(racer), plant.controlDirection(), 1e-12);
  for (int i = 0; i < 10; ++i) {
    const Eigen::Vector4d x = randomState(check.rng());
    check.input(described(racer, x));
    check.near("F", student.forceTerm(x.head<2>(), x.tail<2>(), racer),
               plant.forces(x.head<2>(), x.tail<2>()), 1e-11);
  }
}

/// Exact up to rounding: the error of the method itself is a thousand times as large.
inline void stepFits(rex::grading::Check& check, Student& student, const RacerModel& racer, double tau) {
  const rex::RacerDynamics plant = dynamicsOf(racer);
  for (int i = 0; i < 10; ++i) {
    const Eigen::Vector4d x = randomState(check.rng());
    const double u = check.rng().normal();
    check.input(fmt::format("u {:.4g}, {}", u, described(racer, x)));
    const Eigen::Vector4d rate = plant.derivative(x, u);
    check.near("rate of the state", student.rateOf(x, u, racer), rate, 1e-10 * (1 + rate.norm()));
    check.near("state after a step", student.stepped(x, u, tau, racer), plant.rungeKuttaStep(x, u, tau),
               1e-10 * (1 + tau * rate.norm()));
  }
}

/// A histogram of the noise beside the normal density.
inline rex::grading::Evidence densityOf(const Eigen::MatrixXd& z) {
  rex::Histogram bars = normalized(rex::histogramOf({z.reshaped().begin(), z.reshaped().end()}, 40));
  bars.label = "got";
  std::vector<double> x, density;
  for (double at = -4; at <= 4; at += .05) {
    x.push_back(at);
    density.push_back(std::exp(-at * at / 2) / std::sqrt(2 * M_PI));
  }
  return {.figures = {{.title = "Noise, divided by sqrt(tau) times its deviation",
                       .xLabel = "noise, in standard deviations",
                       .yLabel = "density",
                       .series = {rex::grading::wantedCurve("wanted", x, density)},
                       .histograms = {bars}}}};
}

/// Tolerances of five or six standard errors: about one false alarm in 10^6.
inline void noiseFits(rex::grading::Check& check, Student& student, int steps, double tau, double noise) {
  rex::Rng given = check.rng().split(7);
  check.input(fmt::format("{} steps of {} s, noise {}", steps, tau, noise));
  const Eigen::MatrixXd got = student.kicks(steps, tau, noise, given);
  check.shape("noise", got, 2, steps);
  const Eigen::MatrixXd other = student.kicks(steps, tau, noise, check.rng().split(8));
  check.shape("noise", other, 2, steps);
  check.that("another rng gives other noise", !other.isApprox(got, 1e-9));
  const Eigen::MatrixXd z = got / (std::sqrt(tau) * noise);
  const auto shown = check.show([&] { return densityOf(z); });
  const double n = 2. * steps;
  check.near("mean, in standard deviations", z.mean(), 0, 6 / std::sqrt(n));
  check.near("mean square, relative to the wanted one", z.squaredNorm() / n, 1, 6 * std::sqrt(2 / n));
  check.near("mean of |noise| over the deviation (normal numbers)", z.cwiseAbs().mean(), std::sqrt(2 / M_PI),
             6 * .603 / std::sqrt(n));
  check.near("correlation of the two velocities", z.row(0).dot(z.row(1)) / steps, 0, 6 / std::sqrt(steps));
  check.near("correlation of a step with the next",
             z.leftCols(steps - 1).reshaped().dot(z.rightCols(steps - 1).reshaped()) / n, 0,
             6 / std::sqrt(n));
}

inline rex::LinearizedPlant nearRest(const RacerModel& racer) {
  return dynamicsOf(racer).linearized(Eigen::Vector4d::Zero(), 0);
}

inline void linearFits(rex::grading::Check& check, Student& student, const RacerModel& racer) {
  check.input(described(racer));
  const rex::LinearizedPlant exact = nearRest(racer);
  const Linear got = student.linearNearRest(racer);
  check.near("A", got.A, exact.A, 2e-6 * exact.A.cwiseAbs().maxCoeff());
  check.near("B", got.B, exact.B, 2e-6 * exact.B.cwiseAbs().maxCoeff());
}

inline Eigen::Vector4d bestGain(const RacerModel& racer, const Eigen::Matrix4d& Q, double R) {
  const rex::LinearizedPlant plant = nearRest(racer);
  return rex::lqr({.A = plant.A, .B = plant.B}, Q, Eigen::Matrix<double, 1, 1>(R)).K.transpose();
}

inline void gainFits(rex::grading::Check& check, Student& student, const RacerModel& racer,
                     const Eigen::Vector2d& costs, double R) {
  check.input(
      fmt::format("Q = diag({:.4g}, {:.4g}, 0, 0), R = {:.4g}, {}", costs[0], costs[1], R, described(racer)));
  const rex::LinearizedPlant plant = nearRest(racer);
  const Eigen::Matrix4d Q = Eigen::Vector4d(costs[0], costs[1], 0, 0).asDiagonal();
  const Eigen::Vector4d exact = bestGain(racer, Q, R);
  check.near("K", student.lqrGain({plant.A, plant.B}, Q, R), exact, 2e-6 * exact.cwiseAbs().maxCoeff());
}

/// The racer stays up for 20 s with noise, under the student's linearisation and gain.
inline void gainHolds(rex::grading::Check& check, Student& student, const RacerModel& racer) {
  const rex::RacerDynamics plant = dynamicsOf(racer);
  const Eigen::Matrix4d Q = Eigen::Vector4d(1, 10, 0, 0).asDiagonal();
  const Eigen::Vector4d K = student.lqrGain(student.linearNearRest(racer), Q, 1);
  check.shape("K", K, 4, 1);
  for (const double tilt : {-.2, .2}) {
    Eigen::Vector4d x(0, tilt, 0, 0);
    double farthest = 0;
    for (int t = 0; t < 2000 && farthest <= kLargestAngle; ++t) {
      const double u = std::clamp(-K.dot(x), -kLargestControl, kLargestControl);
      x = plant.noisyStep(x, u, kTau, kNoise, check.rng());
      farthest = std::max(farthest, std::abs(x[1]));
    }
    check.atMost("greatest angle in 20 s under u = -K x, with noise", farthest, kLargestAngle, "rad");
  }
}
