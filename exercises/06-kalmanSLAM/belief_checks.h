#pragma once

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include <Eigen/Cholesky>
#include <fmt/format.h>

#include "car_runs.h"
#include "grading/check.h"
#include "grading/evidence.h"

// What the checks require of values and beliefs, and what they ask if a usual mistake explains a wrong one.

inline bool isNear(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b, double tolerance) {
  return a.rows() == b.rows() && a.cols() == b.cols() && (a.size() == 0 || (a - b).lpNorm<1>() < 1e100) &&
         (a.size() == 0 || (a - b).cwiseAbs().maxCoeff() <= tolerance);
}

/// The numbers from `first` on, as indices.
inline std::vector<int> numbersFrom(int first, int count) {
  std::vector<int> numbers;
  for (int i = 0; i < count; ++i) numbers.push_back(first + i);
  return numbers;
}

/// The name of an entry of a belief about a car, or a car and landmarks.
inline std::string entryName(Eigen::Index entry, Eigen::Index size) {
  constexpr std::array kCar{"x", "y", "heading"};
  if (size < 3 || size % 2 == 0) return fmt::format("entry {}", entry);
  if (entry < 3) return kCar[static_cast<std::size_t>(entry)];
  return fmt::format("{} of landmark {}", entry % 2 == 1 ? "x" : "y", (entry - 3) / 2);
}

/// Two beliefs of the same size, drawn for the two entries in which they differ most.
inline rex::grading::Evidence beliefSeen(const Belief& got, const Belief& wanted, bool isCar = true) {
  const Eigen::VectorXd apart = gapOf(got.mean, wanted.mean).cwiseAbs() +
                                (got.covariance - wanted.covariance).cwiseAbs().rowwise().sum();
  Eigen::Index one = 0, other = 0;
  apart.maxCoeff(&one);
  for (Eigen::Index i = 0; i < apart.size(); ++i)
    if (i != one && (other == one || apart[i] > apart[other])) other = i;
  const std::array<Eigen::Index, 2> both{std::min(one, other), std::max(one, other)};
  const Eigen::Index size = isCar ? apart.size() : 0;
  rex::Figure figure{.title = "The two entries in which the beliefs differ most",
                     .xLabel = entryName(both[0], size),
                     .yLabel = entryName(both[1], size),
                     .equalAxes = true};
  const auto add = [&](const std::string& label, const Belief& belief, const rex::Color& color) {
    const Eigen::VectorXd mean = wanted.mean + gapOf(belief.mean, wanted.mean);
    figure.ellipses.push_back({.label = label + ", 2 sigma",
                               .mean = mean(both),
                               .covariance = belief.covariance(both, both),
                               .color = color});
    figure.series.push_back(
        rex::dots(Eigen::Vector2d(mean(both)), {.label = label + ", mean", .size = 2, .color = color}));
  };
  add("got", got, rex::grading::kGotColor);
  add("wanted", wanted, rex::grading::kWantedColor);
  return {.figures = {figure}};
}

/// Requires exact symmetry, and variance in every direction.
inline void requireCovariance(rex::grading::Check& check, const std::string& function,
                              const Eigen::MatrixXd& S) {
  Eigen::Index row = 0, col = 0;
  const Eigen::MatrixXd apart = (S - S.transpose()).cwiseAbs();
  const double most = apart.maxCoeff(&row, &col);
  {
    const auto rounding = check.ask(
        "These are rounding errors: the mean of a matrix and its transpose is symmetric to the last digit.",
        most <= 1e-9 * S.cwiseAbs().maxCoeff());
    check.atMost(fmt::format("difference of entries ({0}, {1}) and ({1}, {0}) of the covariance of {2}",
                             std::min(row, col), std::max(row, col), function),
                 most, 0);
  }
  check.atLeast("smallest variance on the diagonal of the covariance of " + function, S.diagonal().minCoeff(),
                0);
  check.that("the covariance of " + function + " is positive definite",
             Eigen::LLT<Eigen::MatrixXd>(S).info() == Eigen::Success);
}

/// Requires n numbers, and a covariance of them.
inline void requireBelief(rex::grading::Check& check, const std::string& function, const Belief& belief,
                          Eigen::Index n) {
  check.shape("mean of " + function, belief.mean, n, 1);
  check.shape("covariance of " + function, belief.covariance, n, n);
  requireCovariance(check, function, belief.covariance);
}

/// A wrong belief, by a mistake that students make, and the question about it.
struct WrongBelief {
  const char* question = "";
  Belief belief{};
};

/// Entries of a belief that are compared together: a block of the covariance, or of the mean if it has no
/// columns.
struct BeliefPart {
  std::string name{};  ///< "covariance of the car"
  std::vector<int> rows{}, cols{};
};

inline Eigen::MatrixXd partOf(const Belief& belief, const BeliefPart& part) {
  if (part.cols.empty()) return belief.mean(part.rows);
  return belief.covariance(part.rows, part.cols);
}

/// A function of the contract that returns a belief, and the parts of it that are compared, in this order:
/// the covariance and the mean, if nothing else is said.
struct BeliefFunction {
  std::string name{};
  std::vector<BeliefPart> parts{};
  bool isOfCar = true;  ///< whether the belief begins with the state of a car
};

/// Compares a belief with the wanted one; headings may differ by whole turns.
inline void sameBelief(rex::grading::Check& check, const BeliefFunction& function, Belief got,
                       const Belief& wanted, double tolerance, std::vector<WrongBelief> mistakes = {}) {
  const auto n = static_cast<int>(wanted.mean.size());
  check.shape("mean of " + function.name, got.mean, n, 1);
  check.shape("covariance of " + function.name, got.covariance, n, n);
  const auto shown = check.show([&] { return beliefSeen(got, wanted, function.isOfCar); });
  const auto turned = [&](const Belief& belief) {
    if (!function.isOfCar) return belief;
    return Belief{wanted.mean + gapOf(belief.mean, wanted.mean), belief.covariance};
  };
  got = turned(got);
  const std::vector<int> all = numbersFrom(0, n);
  const std::vector<BeliefPart> whole{{"covariance", all, all}, {"mean", all, {}}};
  for (const BeliefPart& part : function.parts.empty() ? whole : function.parts) {
    std::vector<rex::grading::Mistake> ofPart;
    for (const auto& [question, belief] : mistakes)
      ofPart.push_back({question, partOf(turned(belief), part)});
    check.near(part.name + (function.parts.empty() ? " of " : " by ") + function.name, partOf(got, part),
               partOf(wanted, part), tolerance, ofPart);
    // A mistake that would have shown in this part was not made.
    std::erase_if(mistakes, [&](const WrongBelief& wrong) {
      return !isNear(partOf(turned(wrong.belief), part), partOf(wanted, part), 10 * tolerance);
    });
  }
  requireCovariance(check, function.name, got.covariance);
}
