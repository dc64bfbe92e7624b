#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "grading/check.h"
#include "grading/evidence_parts.h"
#include "interface.h"

// What the children of weighted particles must satisfy, however they are drawn.

// Statistics must lie within this many standard deviations: one correct answer in 25 million does not.
inline constexpr double kSigmas = 5.5;

inline std::string text(double x) { return std::to_string(x).substr(0, 6); }

inline Eigen::VectorXd randomWeights(int count, rex::Rng& rng) {
  Eigen::VectorXd weights = rng.uniformVector(count, 0, 1).array().cube().matrix();
  return weights / weights.sum();
}

// How often each particle is a parent.
inline Eigen::VectorXd childrenOf(rex::grading::Check& check, Student& student,
                                  const Eigen::VectorXd& weights, int count, std::uint64_t seed) {
  const std::vector<int> drawn = student.resampledParents(weights, count, rex::Rng(seed));
  check.near("number of parents", static_cast<double>(drawn.size()), count, 0);
  Eigen::VectorXd children = Eigen::VectorXd::Zero(weights.size());
  for (const int parent : drawn) {
    check.that("every parent is one of the particles", parent >= 0 && parent < weights.size());
    children[parent] += 1;
  }
  return children;
}

// The number of children of each particle, and the number that is due on average.
inline rex::grading::Evidence childrenSeen(const Eigen::VectorXd& children, const Eigen::VectorXd& due) {
  rex::Series wanted{.label = "wanted on average: count * weight",
                     .style = rex::SeriesStyle::kPoints,
                     .marker = rex::Marker::kDot,
                     .size = 1.5,
                     .color = rex::grading::kWantedColor};
  wanted.y.assign(due.begin(), due.end());
  return {.figures = {{.title = "Children of the particles",
                       .xLabel = "number of the particle",
                       .yLabel = "children",
                       .series = {wanted},
                       .histograms = {{.label = "got", .heights = {children.begin(), children.end()}}}}}};
}

inline void keepsWholeParts(rex::grading::Check& check, const Eigen::VectorXd& weights, int count,
                            const Eigen::VectorXd& children) {
  const auto shown = check.show([&] { return childrenSeen(children, count * weights); });
  double missing = 0;
  for (Eigen::Index k = 0; k < weights.size(); ++k) {
    missing = std::max(missing, std::floor(count * weights[k] - 1e-6) - children[k]);
    check.that("no particle of weight zero is a parent", weights[k] > 0 || children[k] == 0);
  }
  check.atMost("children that a particle lacks to reach the integer part of count * weight", missing, 0);
}

// The mean number of children in `calls` calls. In addition to the integer part, f children are due on
// average. Their variance is f (1 - f) if all are drawn with one random number, and at most f if each is
// drawn by itself. Even children that are almost never due may occur five times.
inline void isUnbiased(rex::grading::Check& check, Student& student, const Eigen::VectorXd& weights,
                       int count, int calls) {
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(weights.size());
  for (int i = 0; i < calls; ++i) sum += childrenOf(check, student, weights, count, check.rng().next());
  const auto shown = check.show([&] { return childrenSeen(sum / calls, count * weights); });
  for (Eigen::Index k = 0; k < weights.size(); ++k) {
    const double due = count * weights[k], rest = due - std::floor(due + 1e-9);
    check.near("children of a particle with count * weight = " + text(due) + ", on average", sum[k] / calls,
               due, kSigmas * std::sqrt(std::max(rest, 0.) / calls) + 5. / calls);
  }
}
