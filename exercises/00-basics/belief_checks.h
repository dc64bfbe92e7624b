#pragma once

#include <Eigen/Cholesky>

#include "grading/check.h"
#include "grading/evidence_parts.h"
#include "interface.h"
#include "random_matrices.h"
#include "render/figure_builders.h"

// Part 5: beliefs are compared as densities, with samples, and with sums over a grid.

inline GaussianBelief randomGaussian(rex::Rng& rng, int n) {
  return {rng.normalVector(n), positiveDefinite(rng, n)};
}

// The belief must be a Gaussian the grader can compute with; `size` is the norm its covariance should have.
inline void checkGaussian(rex::grading::Check& check, const GaussianBelief& belief, Eigen::Index n,
                          double size) {
  check.shape("mean", belief.mean, n, 1);
  check.shape("covariance", belief.cov, n, n);
  check.near("covariance against its transpose", belief.cov, belief.cov.transpose(), 1e-9 * (1 + size));
  check.that("the covariance is positive definite", belief.cov.llt().info() == Eigen::Success);
}

// ln N(x | mean, cov), up to terms that do not depend on x.
inline double logDensity(const GaussianBelief& belief, const Eigen::VectorXd& x) {
  return -0.5 * belief.cov.llt().matrixL().solve(x - belief.mean).squaredNorm();
}

// Gaussians in one or more dimensions; the first two are drawn.
inline void addGaussian(rex::Figure& figure, const std::string& label, const GaussianBelief& belief,
                        const rex::Series& look) {
  rex::Series curve = look;
  curve.label = label;
  if (belief.mean.size() == 1) {
    const double sigma = std::sqrt(belief.cov(0, 0));
    for (int i = -60; i <= 60; ++i) {
      curve.x.push_back(belief.mean[0] + sigma * i / 15);
      curve.y.push_back(std::exp(-i * i / 450.) / (std::sqrt(2 * M_PI) * sigma));
    }
  } else {
    const Eigen::Matrix2d root = Eigen::Matrix2d(belief.cov.topLeftCorner<2, 2>()).llt().matrixL();
    for (int i = 0; i <= 100; ++i) {
      const double angle = 2 * M_PI * i / 100;
      const Eigen::Vector2d at =
          belief.mean.head<2>() + 2 * root * Eigen::Vector2d(std::cos(angle), std::sin(angle));
      curve.x.push_back(at.x());
      curve.y.push_back(at.y());
    }
  }
  figure.series.push_back(curve);
}

inline rex::Figure gaussianFigure(const std::string& title, Eigen::Index n) {
  if (n == 1) return {.title = title, .xLabel = "x", .yLabel = "density"};
  return {.title = title + ", 2 sigma", .xLabel = "x_1", .yLabel = "x_2", .equalAxes = true};
}

// Compares the densities themselves at random points: p q / result must be the same everywhere.
inline void productFits(rex::grading::Check& check, Student& student, int n) {
  const GaussianBelief p = randomGaussian(check.rng(), n), q = randomGaussian(check.rng(), n);
  check.input(fmt::format("two random Gaussians in {} dimensions", n));
  const GaussianBelief both = student.product(p, q);
  const Eigen::MatrixXd P = p.cov.inverse(), Q = q.cov.inverse(), S = (P + Q).inverse();
  const GaussianBelief wanted{S * (P * p.mean + Q * q.mean), S};
  const auto shown = check.show([&] {
    rex::Figure figure = gaussianFigure("The product of two Gaussians", n);
    const rex::Series thin{.color = rex::Color{.6f, .62f, .65f}};
    addGaussian(figure, "p", p, thin);
    addGaussian(figure, "q", q, thin);
    addGaussian(figure, "got", both, rex::grading::gotCurve(""));
    addGaussian(figure, "wanted", wanted, rex::grading::wantedCurve(""));
    return rex::grading::Evidence{.figures = {figure}};
  });
  checkGaussian(check, both, n, S.norm());
  const auto logRatio = [&](const Eigen::VectorXd& x, const GaussianBelief& product) {
    return logDensity(p, x) + logDensity(q, x) - logDensity(product, x);
  };
  for (int i = 0; i < 10 + n * n; ++i) {
    const Eigen::VectorXd x = p.mean + check.rng().normalVector(n);
    check.near("change of ln(p(x) q(x) / product(x)), which should not depend on x",
               logRatio(x, both) - logRatio(p.mean, both), 0,
               1e-8 * (1 + std::abs(logDensity(wanted, x)) + std::abs(logRatio(p.mean, wanted))));
  }
}

// Whitened by the right mean and covariance, the samples have mean 0 and covariance Id. The limits are more
// than six standard deviations: less than one false alarm in 1e7 calls.
inline void fitsSamples(rex::grading::Check& check, const GaussianBelief& belief,
                        const Eigen::MatrixXd& samples) {
  const auto shown = check.show([&] {
    rex::Figure figure = gaussianFigure("The belief and samples", samples.rows());
    if (samples.rows() == 1) {
      const Eigen::VectorXd row = samples.row(0);
      figure.histograms = {normalized(rex::histogramOf({row.begin(), row.end()}, 60))};
      figure.histograms[0].label = "samples: wanted";
    } else {
      figure.series.push_back(rex::grading::through(samples.leftCols(1000).colwise(),
                                                    rex::Series{.label = "samples: wanted, 86 % within",
                                                                .style = rex::SeriesStyle::kPoints,
                                                                .marker = rex::Marker::kDot,
                                                                .size = .4,
                                                                .color = rex::grading::kWantedColor}));
    }
    addGaussian(figure, "got", belief, rex::grading::gotCurve(""));
    return rex::grading::Evidence{.figures = {figure}};
  });
  const double count = static_cast<double>(samples.cols());
  const Eigen::MatrixXd centred = samples.colwise() - samples.rowwise().mean();
  checkGaussian(check, belief, samples.rows(), (centred * centred.transpose()).norm() / count);
  const Eigen::MatrixXd Z = belief.cov.llt().matrixL().solve(samples.colwise() - belief.mean);
  const Eigen::MatrixXd Id = Eigen::MatrixXd::Identity(Z.rows(), Z.rows());
  check.atMost("difference from the mean of the samples, in standard deviations of the belief",
               Z.rowwise().mean().cwiseAbs().maxCoeff(), 6.2 / std::sqrt(count));
  check.atMost("relative difference from the covariance of the samples",
               (Z * Z.transpose() / count - Id).cwiseAbs().maxCoeff(), 6.8 * std::sqrt(2 / count));
}

inline void propagationFitsSamples(rex::grading::Check& check, Student& student, int n, int m) {
  rex::Rng& rng = check.rng();
  const GaussianBelief y = randomGaussian(rng, n);
  const Eigen::VectorXd a = rng.normalVector(m);
  const Eigen::MatrixXd F = randomMatrix(rng, m, n), A = positiveDefinite(rng, m);
  const Eigen::MatrixXd rootY = y.cov.llt().matrixL(), rootA = A.llt().matrixL();
  Eigen::MatrixXd samples(m, 20000);
  for (auto x : samples.colwise()) {
    x = a + F * (y.mean + rootY * rng.normalVector(n)) + rootA * rng.normalVector(m);
  }
  check.input(sizes("random y, a, A, and F", m, n) + ", against 20000 samples");
  fitsSamples(check, student.propagated(y, a, F, A), samples);
}

// The densities of Beta beliefs: prior, posterior, and likelihood times prior.
inline rex::grading::Evidence betaSeen(const BetaBelief& prior, const BetaBelief& got,
                                       const std::vector<int>& data) {
  const auto curve = [](rex::Series look, const auto& logDensityAt) {
    double sum = 0;
    for (double mu = .005; mu < 1; mu += .01) {
      look.x.push_back(mu);
      look.y.push_back(std::exp(logDensityAt(mu)));
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

// Posterior / (likelihood * prior) must be the same for all mu on a grid.
inline void betaFits(rex::grading::Check& check, Student& student, int throws) {
  rex::Rng& rng = check.rng();
  const BetaBelief prior{.a = rng.uniform(0.5, 4), .b = rng.uniform(0.5, 4)};
  const double truth = rng.uniform(0.1, 0.9);
  std::vector<int> data;
  for (int i = 0; i < throws; ++i) data.push_back(rng.uniform() < truth ? 1 : 0);
  check.input(fmt::format("prior Beta({:.3f}, {:.3f}), data {}", prior.a, prior.b, fmt::join(data, "")));
  const BetaBelief belief = student.betaPosterior(prior, data);
  const auto shown = check.show([&] { return betaSeen(prior, belief, data); });
  const auto logRatio = [&](double mu) {
    double sum = (prior.a - belief.a) * std::log(mu) + (prior.b - belief.b) * std::log(1 - mu);
    for (const int x : data) sum += std::log(x == 1 ? mu : 1 - mu);
    return sum;
  };
  for (double mu = 0.05; mu < 0.99; mu += 0.05) {
    check.near("ln(likelihood * prior / posterior), which should not depend on mu", logRatio(mu),
               logRatio(0.5), 1e-9 * (1 + throws));
  }
}

inline void dirichletFits(rex::grading::Check& check, Student& student, int outcomes, int turns) {
  rex::Rng& rng = check.rng();
  const Eigen::VectorXd alpha = rng.uniformVector(outcomes, 0.5, 4);
  std::vector<int> data;
  for (int i = 0; i < turns; ++i) data.push_back(1 + std::min(rng.index(outcomes), rng.index(outcomes)));
  check.input(fmt::format("prior Dir with {} outcomes, data {}", outcomes, fmt::join(data, " ")));
  const Eigen::VectorXd posterior = student.dirichletPosterior(alpha, data);
  check.shape("parameters of the posterior", posterior, outcomes, 1);
  const auto logRatio = [&](const Eigen::VectorXd& mu) {
    double sum = (alpha - posterior).dot(Eigen::VectorXd(mu.array().log()));
    for (const int x : data) sum += std::log(mu[x - 1]);
    return sum;
  };
  const Eigen::VectorXd middle = Eigen::VectorXd::Constant(outcomes, 1. / outcomes);
  for (int i = 0; i < 5 * outcomes; ++i) {
    const Eigen::VectorXd weights = rng.uniformVector(outcomes, 0.05, 1);
    check.near("ln(likelihood * prior / posterior), which should not depend on mu",
               logRatio(weights / weights.sum()), logRatio(middle), 1e-9 * (1 + turns));
  }
}

// The mean of mu under Dir(mu | alpha), by summing over a grid on the triangle of three outcomes.
inline Eigen::Vector3d meanOnGrid(const Eigen::Vector3d& alpha) {
  constexpr int kCells = 400;
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  double total = 0;
  for (int i = 1; i < kCells; ++i) {
    for (int j = 1; i + j < kCells; ++j) {
      const Eigen::Vector3d mu(1. * i / kCells, 1. * j / kCells, 1. * (kCells - i - j) / kCells);
      const double density = std::exp((alpha.array() - 1).matrix().dot(mu.array().log().matrix()));
      mean += density * mu;
      total += density;
    }
  }
  return mean / total;
}

// The same for any number of outcomes: the k-th mean is B(alpha + e_k) / B(alpha), where B is the integral
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

inline void predictionIsTheMean(rex::grading::Check& check, Student& student, int outcomes) {
  const Eigen::VectorXd alpha = check.rng().uniformVector(outcomes, 0.3, 6);
  check.input(fmt::format("alpha = ({:.3f})", fmt::join(alpha, ", ")));
  check.near("P(next outcome) against the mean of mu", student.nextOutcome(alpha), meanByIntegrals(alpha),
             1e-10);
}

inline void predictionFits(rex::grading::Check& check, Student& student) {
  const Eigen::Vector3d alpha = check.rng().uniformVector(3, 2, 6);
  check.input(fmt::format("alpha = ({:.3f}, {:.3f}, {:.3f})", alpha[0], alpha[1], alpha[2]));
  check.near("P(next outcome) against the mean of mu on a grid", student.nextOutcome(alpha),
             meanOnGrid(alpha), 1e-3);
}
