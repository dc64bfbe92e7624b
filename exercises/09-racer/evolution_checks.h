#pragma once

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "grading/check.h"
#include "grading/tolerance.h"
#include "noise_checks.h"

// Part 6: an evolution strategy, against its formulas.

inline Eigen::VectorXd meanOfBest(const Eigen::MatrixXd& X, const Eigen::VectorXd& costs, int count) {
  std::vector<std::pair<double, Eigen::Index>> ranking;
  for (Eigen::Index i = 0; i < costs.size(); ++i) ranking.emplace_back(costs[i], i);
  std::sort(ranking.begin(), ranking.end());
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(X.rows());
  for (int i = 0; i < count; ++i) sum += X.col(ranking[static_cast<std::size_t>(i)].second);
  return sum / count;
}

/// c of the contract.
inline double pathShare(const Species& species) { return std::pow(species.mean.size(), -.5); }

/// The deviation after `species`, if |path|^2 / n is `length`.
inline double deviationAfter(const Species& species, double length) {
  return species.deviation * std::exp(.5 * pathShare(species) * (length - 1));
}

/// The species whose mean has moved to `mean`.
inline Species movedTo(const Eigen::VectorXd& mean, const Species& species, int mu) {
  const double c = pathShare(species);
  Species moved{mean, 0, (mean - species.mean) / species.deviation * std::sqrt(mu * (1 - (1 - c) * (1 - c)))};
  moved.path += species.path - c * species.path;
  moved.deviation = deviationAfter(species, moved.path.squaredNorm() / static_cast<double>(mean.size()));
  return moved;
}

/// The first two coordinates of a generation and its means.
inline rex::grading::Evidence generation(const Eigen::MatrixXd& X, const Species& before,
                                         const Eigen::VectorXd& got, const Eigen::VectorXd& wanted) {
  const auto point = [](rex::Series series, const Eigen::MatrixXd& columns, float size) {
    rex::Series points = rex::dots(columns.topRows(2), series);
    points.size = size;
    return points;
  };
  return {.figures = {
              {.title = "A generation and its new mean",
               .xLabel = "first coordinate",
               .yLabel = "second coordinate",
               .equalAxes = true,
               .series = {point({.label = "samples"}, X, 2), point({.label = "mean before"}, before.mean, 4),
                          point(rex::grading::wantedCurve("wanted"), wanted, 5),
                          point(rex::grading::gotCurve("got"), got, 4)}}}};
}

inline void pathFits(rex::grading::Check& check, const Species& before, const Species& got,
                     const Species& wanted, int mu) {
  const double c = pathShare(before), n = static_cast<double>(before.mean.size());
  const double factor = std::sqrt(mu * (1 - (1 - c) * (1 - c)));
  const Eigen::VectorXd step = (wanted.mean - before.mean) / before.deviation, old = (1 - c) * before.path;
  check.near("path of nextSpecies", got.path, wanted.path, 1e-9 * (1 + wanted.path.norm()),
             {{"Is it divided by the new deviation?",
               Eigen::VectorXd(old + factor * before.deviation * step /
                                         deviationAfter(before, before.path.squaredNorm() / n))},
              {"Is mu not below the root?", old + factor * std::sqrt(mu) * step},
              {"Is the path before kept as it is, without the factor 1 - c?", before.path + factor * step},
              {"Does the path lead back, from the new mean to the one before?", old - factor * step}});
  const double length = wanted.path.squaredNorm();
  check.near("deviation of nextSpecies", got.deviation, wanted.deviation, 1e-9 * wanted.deviation,
             {{"Does a long path shrink the deviation?", deviationAfter(before, 2 - length / n)},
              {"Is it c instead of c / 2?", deviationAfter(before, 2 * length / n - 1)},
              {"Is it a factor 1 + c / 2 (...) instead of its exponential?",
               before.deviation * (1 + c / 2 * (length / n - 1))}});
}

inline void selectionFits(rex::grading::Check& check, Student& student, int n, int mu, int lambda) {
  rex::Rng& rng = check.rng();
  const Species before{3 * rng.normalVector(n), rng.uniform(.2, .7), rng.normalVector(n)};
  const Eigen::VectorXd costs = rng.normalVector(lambda);
  const Eigen::MatrixXd X =
      before.mean.replicate(1, lambda) + before.deviation * rng.normalVector(n * lambda).reshaped(n, lambda);
  check.input("a generation", {{"mean", before.mean},
                               {"deviation", before.deviation},
                               {"path", before.path},
                               {"X", X},
                               {"costs", costs},
                               {"mu", mu}});
  const Species got = student.nextSpecies(before, X, costs, mu);
  const Species wanted = movedTo(meanOfBest(X, costs, mu), before, mu);
  check.shape("mean of nextSpecies", got.mean, n, 1);
  const auto shown = check.show([&] { return generation(X, before, got.mean, wanted.mean); });
  check.near(
      "mean of nextSpecies", got.mean, wanted.mean, 1e-9 * (1 + wanted.mean.norm()),
      {{"Is the sum of the selected samples divided by their number?", Eigen::VectorXd(mu * wanted.mean)},
       {"Does the species before count as one of the selected samples?",
        (mu * wanted.mean + before.mean) / (mu + 1)}});
  pathFits(check, before, got, wanted, mu);
}

/// What a program asked for the costs of, in units of the species that had to be sampled, and of others
/// that a mistake would sample.
class Generations {
 public:
  Generations(const Species& start, int mu, int lambda, int count, rex::Rng& rng)
      : start_(start),
        species_(start),
        forgetful_(start),
        mu_(mu),
        lambda_(lambda),
        count_(count),
        goal_(rng.normalVector(static_cast<int>(start.mean.size()))),
        best_(start.mean) {}

  Eigen::VectorXd costs(const Eigen::MatrixXd& X) {
    ++calls_;
    fits_ = fits_ && X.rows() == goal_.size() && X.cols() == lambda_ && X.cwiseAbs().maxCoeff() < 1e9;
    if (!fits_ || isLost_ || calls_ > count_) return Eigen::VectorXd::Ones(X.cols());
    const auto& [mean, deviation, path] = species_;
    note(X, start_.mean, deviation, "Is every generation sampled around the start? Species have a mean.");
    note(X, mean, start_.deviation, "Is every generation sampled with the deviation of the start?");
    note(X, mean, std::sqrt(deviation), "Is the deviation used as the variance?");
    note(X, mean, deviation * deviation, "Is the variance used as the deviation?");
    note(X, mean, 1, "Are samples not multiplied by the deviation?");
    note(X, 0 * mean, deviation, "Is every generation sampled around zero? Species have a mean.");
    note(X, best_, deviation, "Is every generation sampled around the best sample of the one before?");
    draws_.push_back((X.colwise() - mean) / deviation);
    const Eigen::VectorXd values = (X.colwise() - goal_).colwise().squaredNorm();
    const Eigen::VectorXd next = meanOfBest(X, values, mu_);
    forgetful_ = movedTo(next, {mean, deviation, 0 * path}, mu_);
    species_ = movedTo(next, species_, mu_);
    best_ = meanOfBest(X, values, 1);
    isLost_ = !(species_.deviation > 1e-9 && species_.deviation < 1e9);
    return values;
  }

  void areRight(rex::grading::Check& check, const Species& end) const {
    check.that("evolved asks for the costs of lambda samples of n finite coordinates in each call", fits_);
    check.near("number of times that evolved asks for costs", calls_, count_, 0);
    samplesFit(check);
    check.that("the deviation of the species of evolved stays between 1e-9 and 1e9", !isLost_);
    const double size =
        rex::grading::sizeUpTo(1000, species_.mean) + rex::grading::sizeUpTo(1000, species_.path);
    check.near("mean of evolved", end.mean, species_.mean, 1e-9 * size,
               {{"Is it the best sample of the last generation? Wanted is the species.", best_}});
    const auto forgotten =
        check.suspect("Does the path begin with zero in each generation?", forgetful_.path);
    check.near("path of evolved", end.path, species_.path, 1e-9 * size);
    check.near("deviation of evolved", end.deviation, species_.deviation,
               1e-9 * rex::grading::sizeUpTo(1000, Eigen::VectorXd::Constant(1, species_.deviation)));
  }

  const std::vector<Eigen::MatrixXd>& draws() const { return draws_; }

 private:
  /// Sums up how X looks if it was sampled with that mean and deviation, for the question about it.
  void note(const Eigen::MatrixXd& X, const Eigen::VectorXd& mean, double deviation, const char* question) {
    const Eigen::ArrayXXd Z = (X.colwise() - mean) / deviation;
    auto& [sum, squares] = others_[question];
    sum += Z.mean();
    squares += Z.square().mean();
  }

  /// About the mistake that explains what was sampled; empty if none does.
  std::string question() const {
    const auto count = static_cast<double>(draws_.size());
    for (const auto& [question, sums] : others_)
      if (std::abs(sums.first / count) < .15 && std::abs(sums.second / count - 1) < .2) return question;
    return "";
  }

  /// Tolerances of six standard errors.
  void samplesFit(rex::grading::Check& check) const {
    const Eigen::Index n = goal_.size();
    Eigen::MatrixXd Z(n, 0);
    for (const Eigen::MatrixXd& draw : draws_) {
      Z.conservativeResize(n, Z.cols() + lambda_);
      Z.rightCols(lambda_) = draw;
    }
    const double error = 6 / std::sqrt(Z.size());
    const auto shown = check.show(
        [&] { return cloudOf(Z.topRows(2), 1, "first coordinate, in deviations from the mean", "second"); });
    const bool isNew = draws_.size() < 2 || !draws_[0].isApprox(draws_[1], 1e-9);
    const auto copy = check.ask("Does evolved draw from a copy of rng? Pass rng by reference.", !isNew);
    check.that("evolved draws other numbers in each generation", isNew);
    const auto same = check.ask("Is the same number added to all coordinates of a sample?",
                                Z.row(0).isApprox(Z.row(1), 1e-9));
    const auto alike =
        check.ask("Are all samples of a generation the same?", Z.col(0).isApprox(Z.col(1), 1e-9));
    check.near("correlation of the coordinates of the samples of evolved", correlationOf(Z.topRows(2)), 0,
               6 / std::sqrt(Z.cols()));
    const auto other = check.ask(question());
    Eigen::Matrix2Xd successive(2, Z.size() - n);
    successive << Z.leftCols(Z.cols() - 1).reshaped().transpose(),
        Z.rightCols(Z.cols() - 1).reshaped().transpose();
    check.near("correlation of successive samples of evolved", correlationOf(successive), 0, error);
    check.near("samples of evolved less the mean of their species, in units of its deviation, on average",
               Z.rowwise().mean(), Eigen::VectorXd::Zero(n), 6 / std::sqrt(Z.cols()));
    check.near("standard deviation of the samples of evolved, in units of that of their species",
               Z.norm() / std::sqrt(Z.size()), 1, error);
    const auto uniform = check.ask("Are the samples uniform? Wanted are normal ones.");
    check.near("mean size of a coordinate of the samples of evolved, in units of the deviation",
               Z.cwiseAbs().mean(), std::sqrt(2 / M_PI), .603 * error);
  }

  Species start_, species_, forgetful_;  // forgetful: with a path of one generation
  int mu_, lambda_, count_, calls_ = 0;
  bool fits_ = true, isLost_ = false;
  Eigen::VectorXd goal_, best_;
  std::vector<Eigen::MatrixXd> draws_;
  std::map<std::string, std::pair<double, double>> others_;  // question, sums of means and mean squares
};

inline void strategyFits(rex::grading::Check& check, Student& student, int n, int mu, int lambda) {
  constexpr int kGenerations = 12;
  const Species start{5 * check.rng().normalVector(n), check.rng().uniform(.2, .6), Eigen::VectorXd::Zero(n)};
  check.input("a bowl", {{"mean", start.mean},
                         {"deviation", start.deviation},
                         {"mu", mu},
                         {"lambda", lambda},
                         {"generations", kGenerations}});
  const rex::remote::SplitRng one = check.split(7), another = check.split(8);
  const auto run = [&](int count, const rex::remote::SplitRng& given) {
    Generations seen(start, mu, lambda, count, check.rng());
    const Species end = student.evolved([&](const Eigen::MatrixXd& X) { return seen.costs(X); }, start, mu,
                                        lambda, count, given);
    seen.areRight(check, end);
    return seen.draws();
  };
  const Eigen::MatrixXd first = run(kGenerations, one)[0];
  const auto own = check.ask("Does evolved use a generator of its own? All randomness comes from rng.");
  check.that("evolved draws other samples with another rng", !run(1, another)[0].isApprox(first, 1e-9));
}
