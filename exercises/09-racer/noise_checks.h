#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "grading/check.h"
#include "grading/evidence.h"
#include "interface.h"
#include "render/figure_builders.h"

// Part 2: the noise of a ride.

/// A histogram of the noise beside the density that it should have.
inline rex::grading::Evidence densityOf(const Eigen::MatrixXd& noise, double deviation) {
  rex::Histogram bars =
      normalized(rex::sampleHistogram({noise.reshaped().begin(), noise.reshaped().end()}, 40));
  bars.label = "got";
  std::vector<double> x, density;
  for (double at = -4; at <= 4; at += .05) {
    x.push_back(at * deviation);
    density.push_back(std::exp(-at * at / 2) / (std::sqrt(2 * M_PI) * deviation));
  }
  return {.figures = {{.title = "Noise of kicks",
                       .xLabel = "noise of x' [m/s] and of theta' [rad/s]",
                       .yLabel = "density",
                       .series = {rex::grading::wantedCurve("wanted", x, density)},
                       .histograms = {bars}}}};
}

/// The columns of `pairs`, of numbers that should be independent.
inline rex::grading::Evidence cloudOf(const Eigen::Matrix2Xd& pairs, double deviation,
                                      const std::string& xLabel, const std::string& yLabel) {
  rex::Series points = rex::dots(pairs, rex::grading::gotCurve("got"));
  points.size = 1;
  return {.figures = {{.title = "Noise of kicks",
                       .xLabel = xLabel,
                       .yLabel = yLabel,
                       .equalAxes = true,
                       .series = {points},
                       .ellipses = {{.label = "wanted: round, 86 % inside",
                                     .covariance = deviation * deviation * Eigen::Matrix2d::Identity(),
                                     .color = rex::grading::kWantedColor}}}}};
}

inline double correlationOf(const Eigen::Matrix2Xd& pairs) {
  return pairs.row(0).normalized().dot(pairs.row(1).normalized());
}

inline void widthFits(rex::grading::Check& check, const Eigen::MatrixXd& kicks, double tau, double noise) {
  const double n = static_cast<double>(kicks.size()), got = kicks.norm() / std::sqrt(n);
  const auto isAbout = [&](double deviation) { return std::abs(got / deviation - 1) < .1; };
  const auto byTau = check.ask("Is the noise multiplied by tau instead of its root?", isAbout(tau * noise));
  const auto without = check.ask("Is sqrt(tau) left out?", isAbout(noise));
  const auto variance =
      check.ask("Is the variance used as the standard deviation?", isAbout(tau * noise * noise));
  const double wanted = std::sqrt(tau) * noise;
  check.near("standard deviation of kicks", got, wanted, 3 * std::sqrt(2 / n) * wanted);
}

/// Tolerances of five or six standard errors: about one false alarm in 10^6.
inline void noiseFits(rex::grading::Check& check, Student& student, int steps, double tau, double noise) {
  check.input("noise of a ride", {{"steps", steps}, {"tau", tau}, {"noise", noise}});
  const Eigen::MatrixXd got = student.kicks(steps, tau, noise, check.split(7));
  check.shape("noise of kicks", got, 2, steps);
  const Eigen::MatrixXd other = student.kicks(steps, tau, noise, check.split(8));
  check.shape("noise of kicks", other, 2, steps);
  const double deviation = std::sqrt(tau) * noise, n = 2. * steps;
  const auto shown = check.show([&] { return densityOf(got, deviation); });
  widthFits(check, got, tau, noise);
  check.near("mean of kicks", got.mean(), 0, 6 / std::sqrt(n) * deviation);
  const double size = got.cwiseAbs().mean() / deviation;
  const auto uniform =
      check.ask("Are the numbers uniform? Wanted are normal ones.", std::abs(size - std::sqrt(.75)) < .02);
  check.near("mean of |kicks| over their standard deviation", size, std::sqrt(2 / M_PI),
             6 * .603 / std::sqrt(n));
  const auto both = check.show([&] {
    Eigen::Matrix2Xd pairs(2, got.size());
    pairs << got.reshaped().transpose(), other.reshaped().transpose();
    return cloudOf(pairs, deviation, "noise with one rng", "noise with another");
  });
  const auto own = check.ask("Does kicks use a generator of its own? All randomness comes from rng.");
  check.that("kicks gives other noise with another rng", !other.isApprox(got, 1e-9));
  const auto [first, second] = student.kicksOfTwo(steps, tau, noise, check.split(10));
  check.shape("noise of kicks", first, 2, steps);
  const auto copy = check.ask("Does kicks draw from a copy of rng? Pass rng by reference.");
  check.that("kicks gives other noise when it is called again with the same rng",
             !second.isApprox(first, 1e-9));
}

/// The numbers of one ride are independent of each other.
inline void noiseIsIndependent(rex::grading::Check& check, Student& student, int steps) {
  const double tau = .01, noise = .1, deviation = std::sqrt(tau) * noise;
  check.input("noise of a ride", {{"steps", steps}, {"tau", tau}, {"noise", noise}});
  const Eigen::Matrix2Xd got = student.kicks(steps, tau, noise, check.split(9));
  check.shape("noise of kicks", got, 2, steps);
  const auto ofBoth =
      check.show([&] { return cloudOf(got, deviation, "noise of x' [m/s]", "noise of theta' [rad/s]"); });
  {
    const auto same = check.ask("Do both velocities get the same number?", got.row(0) == got.row(1));
    check.near("correlation of the noise of x' and of theta' by kicks", correlationOf(got), 0,
               6 / std::sqrt(steps));
  }
  Eigen::Matrix2Xd successive(2, 2 * steps - 2);
  successive << got.leftCols(steps - 1).reshaped().transpose(),
      got.rightCols(steps - 1).reshaped().transpose();
  const auto inTime =
      check.show([&] { return cloudOf(successive, deviation, "noise of a step", "noise of the next step"); });
  check.near("correlation of the noise of a step and of the next by kicks", correlationOf(successive), 0,
             6 / std::sqrt(2. * steps));
}
