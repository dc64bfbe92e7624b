#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Cholesky>

#include "grading/check.h"
#include "grading/evidence.h"
#include "interface.h"
#include "random_matrices.h"

// Part 5: beliefs, compared by their parameters.

inline GaussianBelief randomGaussian(rex::Rng& rng, int n) {
  return {rng.normalVector(n), positiveDefinite(rng, n)};
}

// Gaussians in one or more dimensions; the first two are drawn.
inline void addGaussian(rex::Figure& figure, const std::string& label, const GaussianBelief& belief,
                        const rex::Series& look) {
  rex::Series curve = look;
  curve.label = label;
  if (belief.mean.size() == 1) {
    const double sigma = std::sqrt(belief.cov(0, 0));
    for (int i = -60; i <= 60; ++i) {
      curve.add(belief.mean[0] + sigma * i / 15, std::exp(-i * i / 450.) / (std::sqrt(2 * M_PI) * sigma));
    }
  } else {
    const Eigen::Matrix2d root = Eigen::Matrix2d(belief.cov.topLeftCorner<2, 2>()).llt().matrixL();
    for (int i = 0; i <= 100; ++i) {
      const double angle = 2 * M_PI * i / 100;
      const Eigen::Vector2d at =
          belief.mean.head<2>() + 2 * root * Eigen::Vector2d(std::cos(angle), std::sin(angle));
      curve.add(at.x(), at.y());
    }
  }
  figure.series.push_back(curve);
}

inline rex::Figure gaussianFigure(const std::string& title, Eigen::Index n) {
  if (n == 1) return {.title = title, .xLabel = "x", .yLabel = "density"};
  return {.title = title + ", 2 sigma", .xLabel = "x_1", .yLabel = "x_2", .equalAxes = true};
}

using GivenBeliefs = std::vector<std::pair<std::string, GaussianBelief>>;

// The picture shows what was given in grey. A belief without a density is not drawn.
inline rex::grading::Evidence gaussiansSeen(const std::string& title, const GivenBeliefs& given,
                                            const GaussianBelief& got, const GaussianBelief& wanted) {
  rex::Figure figure = gaussianFigure(title, wanted.mean.size());
  for (const auto& [name, belief] : given)
    addGaussian(figure, name, belief, {.color = rex::Color{.6f, .62f, .65f}});
  if (got.cov.llt().info() == Eigen::Success) addGaussian(figure, "got", got, rex::grading::gotCurve(""));
  addGaussian(figure, "wanted", wanted, rex::grading::wantedCurve(""));
  return {.figures = {figure}};
}

inline double toleranceOf(const Eigen::MatrixXd& wanted) { return 1e-9 * (1 + wanted.norm()); }

inline void productFits(rex::grading::Check& check, Student& student, int n) {
  const GaussianBelief p = randomGaussian(check.rng(), n), q = randomGaussian(check.rng(), n);
  check.input(
      "two random Gaussians p and q",
      {{"mean of p", p.mean}, {"covariance of p", p.cov}, {"mean of q", q.mean}, {"covariance of q", q.cov}});
  const GaussianBelief both = student.product(p, q);
  const Eigen::MatrixXd P = p.cov.inverse(), Q = q.cov.inverse(), S = (P + Q).inverse();
  const GaussianBelief wanted{S * (P * p.mean + Q * q.mean), S};
  check.shape("covariance of product", both.cov, n, n);
  check.shape("mean of product", both.mean, n, 1);
  const auto shown = check.show([&] {
    return gaussiansSeen("The product of p and q", {{"p", p}, {"q", q}}, both, wanted);
  });
  check.near("covariance of product", both.cov, S, 10 * toleranceOf(S));
  check.near("mean of product", both.mean, wanted.mean, 10 * toleranceOf(wanted.mean));
}

// The wanted covariance is that of a + F y + noise for y and the noise as sums of independent numbers.
inline void propagationFits(rex::grading::Check& check, Student& student, int n, int m) {
  rex::Rng& rng = check.rng();
  const GaussianBelief y = randomGaussian(rng, n);
  const Eigen::VectorXd a = rng.normalVector(m);
  const Eigen::MatrixXd F = randomMatrix(rng, m, n), A = positiveDefinite(rng, m);
  const Eigen::MatrixXd rootY = y.cov.llt().matrixL(), rootA = A.llt().matrixL();
  check.input("a random belief about y",
              {{"mean", y.mean}, {"covariance", y.cov}, {"a", a}, {"F", F}, {"A", A}});
  Eigen::MatrixXd spread(m, n + m);
  spread << F * rootY, rootA;
  const GaussianBelief wanted{F * y.mean + a, spread * spread.transpose()};
  const GaussianBelief got = student.propagated(y, a, F, A);
  check.shape("covariance of propagated", got.cov, m, m);
  check.shape("mean of propagated", got.mean, m, 1);
  const auto shown = check.show([&] { return gaussiansSeen("The belief about a + F y", {}, got, wanted); });
  check.near("covariance of propagated", got.cov, wanted.cov, toleranceOf(wanted.cov));
  check.near("mean of propagated", got.mean, wanted.mean, toleranceOf(wanted.mean));
}

// The densities of Beta beliefs: prior, posterior, and likelihood times prior.
inline rex::grading::Evidence betaSeen(const BetaBelief& prior, const BetaBelief& got,
                                       const std::vector<int>& data) {
  const auto curve = [](rex::Series look, const auto& logDensityAt) {
    double sum = 0;
    for (double mu = .005; mu < 1; mu += .01) {
      look.add(mu, std::exp(logDensityAt(mu)));
      sum += .01 * look.y.back();
    }
    for (double& y : look.y) y /= sum;
    return look;
  };
  const auto beta = [](const BetaBelief& belief) {
    return [belief](double mu) { return (belief.a - 1) * std::log(mu) + (belief.b - 1) * std::log(1 - mu); };
  };
  const auto posterior = [&](double mu) {
    double log = beta(prior)(mu);
    for (const int x : data) log += std::log(x == 1 ? mu : 1 - mu);
    return log;
  };
  return {
      .figures = {{.title = "The belief about mu",
                   .xLabel = "mu",
                   .yLabel = "density",
                   .series = {curve({.label = "prior", .color = rex::Color{.6f, .62f, .65f}}, beta(prior)),
                              curve(rex::grading::gotCurve("got"), beta(got)),
                              curve(rex::grading::wantedCurve("wanted: likelihood * prior"), posterior)}}}};
}

// The prior with one more for each time an outcome is seen.
inline Eigen::VectorXd counted(Eigen::VectorXd prior, const std::vector<int>& data, int first) {
  for (Eigen::Index k = 0; k < prior.size(); ++k)
    prior[k] += static_cast<double>(std::count(data.begin(), data.end(), first + static_cast<int>(k)));
  return prior;
}

inline void posteriorFits(rex::grading::Check& check, const std::string& property, const Eigen::VectorXd& got,
                          const Eigen::VectorXd& wanted) {
  check.near(property, got, wanted, 1e-9 * (1 + wanted.norm()));
}

inline void betaFits(rex::grading::Check& check, Student& student, int throws) {
  rex::Rng& rng = check.rng();
  const BetaBelief prior{.a = rng.uniform(0.5, 4), .b = rng.uniform(0.5, 4)};
  const double truth = rng.uniform(0.1, 0.9);
  std::vector<int> data;
  for (int i = 0; i < throws; ++i) data.push_back(rng.uniform() < truth ? 1 : 0);
  const Eigen::Vector2d before(prior.a, prior.b);
  check.input(fmt::format("data {}", fmt::join(data, "")), {{"(a, b) of the prior", before}});
  const BetaBelief belief = student.betaPosterior(prior, data);
  const Eigen::Vector2d wanted = counted(before.reverse(), data, 0).reverse();
  const auto shown = check.show([&] { return betaSeen(prior, belief, data); });
  posteriorFits(check, "(a, b) of betaPosterior", Eigen::Vector2d(belief.a, belief.b), wanted);
}

inline void dirichletFits(rex::grading::Check& check, Student& student, int outcomes, int turns) {
  rex::Rng& rng = check.rng();
  const Eigen::VectorXd alpha = rng.uniformVector(outcomes, 0.5, 4);
  std::vector<int> data;
  for (int i = 0; i < turns; ++i) data.push_back(1 + std::min(rng.index(outcomes), rng.index(outcomes)));
  check.input(fmt::format("data {}", fmt::join(data, " ")), {{"alpha", alpha}});
  posteriorFits(check, "alpha of dirichletPosterior", student.dirichletPosterior(alpha, data),
                counted(alpha, data, 1));
}

// The mean of mu under Dir(mu | alpha): its k-th number is B(alpha + e_k) / B(alpha), where B is the integral
// over mu of the product of all mu_k^(alpha_k - 1).
inline Eigen::VectorXd meanByIntegrals(const Eigen::VectorXd& alpha) {
  const auto logB = [](const Eigen::VectorXd& exponents) {
    double sum = -std::lgamma(exponents.sum());
    for (const double a : exponents) sum += std::lgamma(a);
    return sum;
  };
  Eigen::VectorXd mean(alpha.size());
  for (Eigen::Index k = 0; k < alpha.size(); ++k) {
    mean[k] = std::exp(logB(alpha + Eigen::VectorXd::Unit(alpha.size(), k)) - logB(alpha));
  }
  return mean;
}

inline void predictionFits(rex::grading::Check& check, Student& student, int outcomes) {
  const Eigen::VectorXd alpha = check.rng().uniformVector(outcomes, 0.3, 6);
  check.input("a Dirichlet belief", {{"alpha", alpha}});
  check.near("P(next outcome) of nextOutcome", student.nextOutcome(alpha), meanByIntegrals(alpha), 1e-10);
}
