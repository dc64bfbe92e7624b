#pragma once

#include <vector>

#include "course/linear_algebra.h"
#include "gradient_checks.h"

// Part 8: the natural gradient.

/// The mean over trials of the sum of phi phi^T with these weights.
inline Eigen::MatrixXd fisherBy(const Practice& given, WeightOfStep weight) {
  const Eigen::Index k = given.policy.beta.size();
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(k, k);
  for (const StepOfTrial& step : stepsOf(given)) sum += weight(step) * step.phi * step.phi.transpose();
  return sum / static_cast<double>(given.trials.size());
}

/// The same made of the sums of dlog pi over whole trials.
inline Eigen::MatrixXd fisherOfSums(const Practice& given, WeightOfStep weight) {
  const Eigen::Index k = given.policy.beta.size();
  Eigen::MatrixXd mean = Eigen::MatrixXd::Zero(k, k);
  for (const Rollout& trial : given.trials) {
    const Eigen::VectorXd sum = gradientBy({given.policy, {trial}, given.discount}, weight);
    mean += sum * sum.transpose() / static_cast<double>(given.trials.size());
  }
  return mean;
}

struct NaturalPractice {
  Practice given;
  Eigen::MatrixXd F;
  Eigen::VectorXd g, w;
};

/// No eigenvalue of F is below a hundredth of the largest, so rounding does not matter.
inline NaturalPractice naturalPractice(rex::Rng& rng, int k, int count) {
  for (;;) {
    NaturalPractice made{randomPractice(rng, k, count), {}, {}, {}};
    const rex::LinearGaussianPolicy policy = asLibrary(made.given.policy);
    const std::vector<rex::Episode> trials = episodesOf(made.given.trials);
    made.F = rex::naturalGradient(policy, trials, made.given.discount).fisher;
    made.g = rex::reinforceGradient(policy, trials, made.given.discount, rex::Baseline::kNone).gradient;
    const Eigen::VectorXd sizes = rex::svd(made.F).s;
    if (!(sizes[k - 1] > sizes[0] / 100)) continue;  // not if all are zero either
    made.w = rex::solveMatrix(made.F, made.g);
    return made;
  }
}

inline std::vector<Mistake> mistakenNaturalGradients(const NaturalPractice& made) {
  using S = StepOfTrial;
  const Practice& given = made.given;
  const Eigen::MatrixXd &F = made.F, Sigma = asLibrary(given.policy).Sigma;
  const Eigen::VectorXd &g = made.g, &w = made.w;
  const auto with = [&](const Eigen::MatrixXd& matrix) { return rex::leastSquares(matrix, g); };
  const auto by = [&](WeightOfStep weight) { return with(fisherBy(given, weight)); };
  const double trials = static_cast<double>(given.trials.size()),
               steps = static_cast<double>(stepsOf(given).size());
  const Eigen::VectorXd late = gradientBy(given, [](const S& s) { return s.Q * s.moved / s.variance; });
  const Eigen::MatrixXd lateF =
      fisherBy(given, [](const S& s) { return s.moved * s.moved / (s.variance * s.variance); });
  const char* const sums = "Is F made of sums over a trial? It is the sum of products, one for each step.";
  std::vector<Mistake> mistakes{
      {"Is it the new beta? Wanted is w alone.", given.policy.beta + w},
      {"Is the factor discount^t of each step left out of F and of g?", rex::leastSquares(lateF, late)},
      {"Is discount^t squared in F? It is a factor of each product, not of both dlog pi.",
       by([](const S& s) { return s.faded * s.faded * s.moved * s.moved / (s.variance * s.variance); })},
      {"Is F the mean over the steps? It is that over the trials.", w * steps / trials},
      {"Is the variance of the action, phi^T Sigma phi, left out of F?",
       by([](const S& s) { return s.faded * s.moved * s.moved; })},
      {"Is the variance in F |L phi|^2? It is phi^T Sigma phi = |L^T phi|^2.",
       by([](const S& s) { return s.faded * s.moved * s.moved / (s.mistaken * s.mistaken); })},
      {"Is F made of the features alone? It is made of dlog pi.", by([](const S& s) { return s.faded; })},
      {"Do the returns count in F? They belong to g.",
       by([](const S& s) { return s.faded * s.Q * s.moved * s.moved / (s.variance * s.variance); })},
      {sums, with(fisherOfSums(given, [](const S& s) { return s.faded * s.moved / s.variance; }))},
      {sums, with(fisherOfSums(given, [](const S& s) { return s.moved / s.variance; }))},
      {"Is F a diagonal matrix? Its other entries count, too.", g.cwiseQuotient(F.diagonal())},
      {"Is Sigma taken for the inverse of F?", Sigma * g}};
  for (const Mistake& mistake : mistakenGradients(given, g))
    mistakes.push_back(
        {"Is F right, but g not what `reinforce` should return?", rex::leastSquares(F, mistake.value)});
  return mistakes;
}

inline void naturalGradientFits(rex::grading::Check& check, Student& student, int k, int count) {
  const NaturalPractice made = naturalPractice(check.rng(), k, count);
  describe(check, made.given);
  const Eigen::VectorXd got =
      student.naturalGradientOf(made.given.policy, made.given.trials, made.given.discount);
  const auto shown =
      check.show([&] { return arrowsSeen("w of naturalGradientOf", Eigen::VectorXd::Zero(2), got, made.w); });
  const double tolerance = 1e-6 * made.w.norm();
  check.near("w of naturalGradientOf", got, made.w, tolerance, mistakenNaturalGradients(made));
}
