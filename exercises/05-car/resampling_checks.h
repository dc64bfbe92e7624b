#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "grading/check.h"
#include "grading/evidence.h"
#include "interface.h"

// What the children of weighted particles must satisfy, however they are drawn.

// Statistics must lie within this many standard deviations: one correct answer in 25 million does not.
inline constexpr double kSigmas = 5.5;

inline Eigen::VectorXd randomWeights(int count, rex::Rng& rng) {
  Eigen::VectorXd weights = rng.uniformVector(count, 0, 1).array().cube().matrix();
  return weights / weights.sum();
}

/// Of count * weight.
inline Eigen::VectorXd wholePartsOf(const Eigen::VectorXd& weights, int count) {
  return weights.unaryExpr([&](double weight) { return std::floor(count * weight + 1e-9); });
}

/// How often each particle is a parent.
inline Eigen::VectorXd childrenOf(rex::grading::Check& check, Student& student,
                                  const Eigen::VectorXd& weights, int count,
                                  const rex::remote::SplitRng& rng) {
  const std::vector<int> drawn = student.resampledParents(weights, count, rng);
  const int got = static_cast<int>(drawn.size());
  {
    const int whole = static_cast<int>(wholePartsOf(weights, count).sum());
    const auto rest = check.ask("Are only the integer parts of count * weight there? The rest is missing.",
                                got == whole && whole < count);
    const auto particles = check.ask("Are there as many parents as particles? Wanted are `count`.",
                                     got == weights.size() && count != weights.size());
    check.near("number of parents of resampledParents", got, count, 0);
  }
  const auto [least, most] = std::minmax_element(drawn.begin(), drawn.end());
  const auto fromOne =
      check.ask("Are particles numbered from 1? Wanted is from 0.", *least >= 1 && *most == weights.size());
  check.atLeast("smallest number of a parent of resampledParents", *least, 0);
  check.atMost("largest number of a parent of resampledParents", *most,
               static_cast<double>(weights.size()) - 1);
  Eigen::VectorXd children = Eigen::VectorXd::Zero(weights.size());
  for (const int parent : drawn) children[parent] += 1;
  return children;
}

/// The number of children of each particle, the number that is due on average, and a ring around one
/// of the parents.
inline rex::grading::Evidence childrenSeen(const Eigen::VectorXd& children, const Eigen::VectorXd& due,
                                           Eigen::Index number, const std::string& parent = "particle") {
  rex::Series wanted{.label = "wanted on average: count * weight",
                     .style = rex::SeriesStyle::kPoints,
                     .marker = rex::Marker::kDot,
                     .size = 1.5,
                     .color = rex::grading::kWantedColor};
  wanted.y.assign(due.begin(), due.end());
  const double at = static_cast<double>(number);
  return {.figures = {{.title = "Children of each " + parent,
                       .xLabel = "number of the " + parent,
                       .yLabel = "children",
                       .legend = rex::Legend::kOutside,
                       .series = {wanted, rex::grading::wrongPoint("the " + parent + " in question", at,
                                                                   children[number])},
                       .histograms = {{.label = "got", .heights = {children.begin(), children.end()}}}}}};
}

/// Whether children are as they would be if each were drawn by itself.
inline bool seemIndependent(const Eigen::VectorXd& children, const Eigen::VectorXd& due) {
  double squares = 0;
  for (Eigen::Index k = 0; k < due.size(); ++k)
    squares += std::pow(children[k] - due[k], 2) / std::max(due[k], 1e-9) / static_cast<double>(due.size());
  return due.size() >= 8 && squares > .4 && squares < 2.5;
}

/// `weights` are the input of the check, which then names the particle.
inline void keepsWholeParts(rex::grading::Check& check, const Eigen::VectorXd& weights, int count,
                            const Eigen::VectorXd& children) {
  const Eigen::VectorXd due = count * weights;
  const auto lacks = [&](Eigen::Index k) { return std::floor(due[k] - 1e-6) - children[k]; };
  Eigen::Index worst = 0, largest = 0, other = 0;
  double undue = 0;
  for (Eigen::Index k = 0; k < due.size(); ++k) {
    if (lacks(k) > lacks(worst)) worst = k;
    if (weights[k] > 0 || children[k] <= undue) continue;
    undue = children[k];
    other = k;
  }
  weights.maxCoeff(&largest);
  const auto seenAt = [&](Eigen::Index particle) { return childrenSeen(children, due, particle); };
  {
    const auto shown = check.show([&] { return seenAt(other); });
    check.atMost("number of children of a particle of weight zero by resampledParents", undue, 0);
  }
  check.input(fmt::format("{}; particle {} has count * weight = {:.4f}", check.input(), worst, due[worst]));
  const auto shown = check.show([&] { return seenAt(worst); });
  const auto one = check.ask("Does only the heaviest particle have children?", children[largest] == count);
  const auto equal = check.ask("Do all particles have one child, whatever their weight?",
                               children.minCoeff() == 1 && children.maxCoeff() == 1);
  const auto independent =
      check.ask("Is each parent drawn by itself? Then no number is certain.", seemIndependent(children, due));
  check.atLeast("number of children of a particle by resampledParents", children[worst],
                std::max(0., children[worst] + lacks(worst)));
}

/// The mean number of children in `calls` calls. In addition to the integer part, f children are due on
/// average. Their variance is f (1 - f) if all are drawn with one random number, and at most f if each is
/// drawn by itself. Even children that are almost never due may occur five times.
inline void isUnbiased(rex::grading::Check& check, Student& student, const Eigen::VectorXd& weights,
                       int count, int calls) {
  const std::string input = fmt::format("{} calls", calls);
  const auto given = [&](const std::string& text) {
    check.input(text, {{"weights", weights}, {"count", count}});
  };
  given(input);
  Eigen::VectorXd mean = Eigen::VectorXd::Zero(weights.size());
  for (int i = 0; i < calls; ++i)
    mean += childrenOf(check, student, weights, count, check.split(check.rng().next())) / calls;
  Eigen::Index here = 0;
  const auto shown = check.show([&] { return childrenSeen(mean, count * weights, here); });
  const Eigen::VectorXd whole = wholePartsOf(weights, count);
  const double alike = (count - whole.sum()) / static_cast<double>(weights.size());
  bool areWhole = true, areAlike = true;
  for (Eigen::Index k = 0; k < mean.size(); ++k) {
    areWhole = areWhole && std::abs(mean[k] - std::round(mean[k])) < 1e-6;
    areAlike = areAlike && std::abs(mean[k] - whole[k] - alike) < .1;
  }
  const auto always =
      check.ask("Do the same particles have children in each call? The rest is up to chance.", areWhole);
  const auto equal =
      check.ask("Does the rest go to all particles alike? The fractions of count * weight differ.", areAlike);
  for (; here < weights.size(); ++here) {
    const double due = count * weights[here], rest = due - std::floor(due + 1e-9);
    given(fmt::format("{}, particle {}", input, here));
    check.near("mean number of children of a particle by resampledParents", mean[here], due,
               kSigmas * std::sqrt(std::max(rest, 0.) / calls) + 5. / calls);
  }
}

/// Parents depend on rng and on nothing else.
inline void drawsFromRng(rex::grading::Check& check, Student& student) {
  const Eigen::VectorXd weights = randomWeights(30, check.rng());
  check.input("two calls", {{"weights", weights}, {"count", 30}});
  const rex::remote::SplitRng rng = check.split(check.rng().next());
  const Eigen::VectorXd one = childrenOf(check, student, weights, 30, rng),
                        same = childrenOf(check, student, weights, 30, rng);
  const auto outside = check.ask("Is there other randomness, as from rand()? All randomness comes from rng.");
  check.that("resampledParents gives the same parents with the same rng", one == same);
}
