#pragma once

#include <algorithm>
#include <limits>
#include <optional>

#include "cart_checks.h"
#include "control/gain_search.h"
#include "grading/check.h"
#include "interface.h"
#include "plants.h"

// Parts 2 and 5: what must hold for P and for gains.

/// The bracket of 12.11.1 b.
inline Eigen::MatrixXd imbalance(const Plant& plant, const Costs& costs, const Eigen::MatrixXd& P) {
  const Eigen::MatrixXd K = rex::solve(costs.R, Eigen::MatrixXd(plant.B.transpose() * P));
  const Eigen::MatrixXd PA = P * plant.A;
  return PA + PA.transpose() - K.transpose() * costs.R * K + costs.Q;
}

/// Iterates with step size epsilon until no entry of the bracket exceeds the tolerance. Returns the number
/// of steps, or -1 if it is more than `most`.
inline int stepsUntil(const Plant& plant, const Costs& costs, double epsilon, double tolerance, int most) {
  Eigen::MatrixXd now = costs.Q;
  for (int count = 0; count <= most; ++count) {
    const Eigen::MatrixXd rate = imbalance(plant, costs, now);
    if (rate.lpNorm<Eigen::Infinity>() <= tolerance) return count;
    now += epsilon * rate;
  }
  return -1;
}

/// The bracket of P_steps and the least of those before: the mean of their largest entries, which rounding
/// cannot reach. Brackets need not fall with each step.
inline double betweenSteps(const Plant& plant, const Costs& costs, double epsilon, int steps) {
  Eigen::MatrixXd now = costs.Q;
  double before = std::numeric_limits<double>::infinity();
  for (int count = 0;; ++count) {
    const Eigen::MatrixXd rate = imbalance(plant, costs, now);
    const double size = rate.lpNorm<Eigen::Infinity>();
    if (count == steps) return (before + size) / 2;
    before = std::min(before, size);
    now += epsilon * rate;
  }
}

inline double largestOf(const Eigen::MatrixXd& bracket) { return bracket.cwiseAbs().maxCoeff(); }

/// P_1, P_2 and P_3 of a small plant, each the first within a wide tolerance. So a wrong term of the bracket
/// is not taken for a loop that is a step too short. The norms of the last two brackets exceed the tolerance.
inline void firstStepsFit(rex::grading::Check& check, Student& student) {
  Plant plant{Eigen::MatrixXd(2, 2), Eigen::MatrixXd(2, 2)};
  plant.A << -1, .5, .25, -2;
  plant.B << 1, .5, 0, 2;
  Costs costs{Eigen::MatrixXd(2, 2), Eigen::MatrixXd(2, 2)};
  costs.Q << 1, .2, .2, 2;
  costs.R << 2, .5, .5, 1;
  constexpr double kEpsilon = .05;
  Eigen::MatrixXd wanted = costs.Q;
  for (int steps = 1; steps <= 3; ++steps) {
    wanted += kEpsilon * imbalance(plant, costs, wanted);
    const double tolerance = steps == 1 ? betweenSteps(plant, costs, kEpsilon, steps)
                                        : 1.03 * largestOf(imbalance(plant, costs, wanted));
    check.input("a small plant and its costs", {{"A", plant.A},
                                                {"B", plant.B},
                                                {"Q", costs.Q},
                                                {"R", costs.R},
                                                {"epsilon", kEpsilon},
                                                {"tolerance", tolerance},
                                                {"most", 50}});
    const std::optional<Eigen::MatrixXd> P = student.iterated(plant, costs, kEpsilon, tolerance, 50);
    check.that("iterated returns a P where a few steps are enough", P.has_value());
    check.shape("P of iterated", *P, 2, 2);
    check.near("P of iterated, which needs few steps", *P, wanted, 1e-9);
  }
}

inline void iterationFits(rex::grading::Check& check, Student& student, const Regulation& task,
                          double epsilon, double tolerance) {
  const auto& [plant, costs, optimal] = task;
  const int steps = stepsUntil(plant, costs, epsilon, tolerance, 100000);
  tolerance = betweenSteps(plant, costs, epsilon, steps);
  check.input("a plant and its costs", {{"A", plant.A},
                                        {"B", plant.B},
                                        {"Q", costs.Q},
                                        {"R", costs.R},
                                        {"epsilon", epsilon},
                                        {"tolerance", tolerance},
                                        {"most", steps}});
  const std::optional<Eigen::MatrixXd> P = student.iterated(plant, costs, epsilon, tolerance, steps);
  {
    const auto unseen = check.ask("Is P_most looked at, too?",
                                  !P && student.iterated(plant, costs, epsilon, tolerance, steps + 1));
    check.that("iterated returns a P if `most` is just enough", P.has_value());
  }
  check.shape("P of iterated", *P, plant.A.rows(), plant.A.rows());
  const double size = imbalance(plant, costs, *P).lpNorm<Eigen::Infinity>();
  {
    const auto change =
        check.ask("Is the change of P compared with the tolerance? It is epsilon times the bracket.",
                  epsilon * size <= tolerance);
    check.atMost("largest entry of the bracket for the P of iterated", size, tolerance * 1.001);
  }
  check.atLeast("largest entry of the bracket for the first P within the tolerance, in iterated", size,
                tolerance * .8);
  check.near("P of iterated", *P, optimal.X, 1e-3 * (1 + optimal.X.norm()));
  const auto last = check.ask("Is the last P returned although its bracket exceeds the tolerance?");
  check.that("iterated returns nothing if `most` is one step too few",
             !student.iterated(plant, costs, epsilon, tolerance, steps - 1));
}

/// A = 0, B = (1, 0), Q = I: the control cannot move the second state, so its costs never end.
inline void iterationEnds(rex::grading::Check& check, Student& student) {
  const Plant plant{Eigen::MatrixXd::Zero(2, 2), Eigen::Vector2d(1, 0)};
  check.input("A = 0, B = (1, 0), Q = I, R = 1, epsilon = 0.01");
  const Costs costs{Eigen::MatrixXd::Identity(2, 2), Eigen::MatrixXd::Identity(1, 1)};
  check.that("iterated returns nothing if there is no P", !student.iterated(plant, costs, .01, 1e-3, 5000));
}

/// The bracket shows how exact P is, but not what is wrong with it: first P is compared with the wanted one,
/// as far as that is known.
inline void hamiltonianFits(rex::grading::Check& check, Student& student, const Regulation& task) {
  const auto& [plant, costs, optimal] = task;
  describe(check, "a plant and its costs", plant, costs);
  const Eigen::MatrixXd P = student.viaHamiltonian(plant, costs);
  check.shape("P of viaHamiltonian", P, plant.A.rows(), plant.A.rows());
  const double scale = 1 + costs.Q.norm() + 2 * (optimal.X * plant.A).norm();
  check.near("P of viaHamiltonian", P, optimal.X, 1e-3 * (1 + optimal.X.norm()));
  check.near("P of viaHamiltonian, transposed", P.transpose(), P, 1e-9 * optimal.X.norm());
  check.near("bracket for the P of viaHamiltonian", imbalance(plant, costs, P),
             Eigen::MatrixXd::Zero(P.rows(), P.cols()), 1e-8 * scale);
}

inline void gainsFit(rex::grading::Check& check, Student& student, const Regulation& task) {
  const auto& [plant, costs, optimal] = task;
  check.input("a plant, its costs and their P", {{"B", plant.B}, {"R", costs.R}, {"P", optimal.X}});
  check.near("K of gainOf", student.gainOf(plant, costs, optimal.X), -optimal.K,
             1e-8 * (1 + optimal.K.norm()));
}

/// The same for the cart of the sheet, with its motion.
inline void gainsOfTheSheetFit(rex::grading::Check& check, Student& student) {
  const auto [plant, costs, optimal] = regulationOf(plantOf({}), costsOfTheSheet());
  check.input("the cart of the sheet", {{"B", plant.B}, {"R", costs.R}, {"P", optimal.X}});
  const Eigen::MatrixXd K = student.gainOf(plant, costs, optimal.X), wanted = -optimal.K;
  check.shape("K of gainOf", K, 1, 4);
  const auto shown = check.show([&] { return seenUnder(K, wanted); });
  check.near("K of gainOf", K, wanted, 1e-8 * (1 + wanted.norm()));
}

/// The search starts from the gains that are optimal for the sheet's costs; no gain may become larger than
/// the largest of them. In 1300 searches of the reference on random carts the share was below 0.82 in 1 %
/// and never below 0.71.
inline void gainsAreQuick(rex::grading::Check& check, Student& student, const PoleCart& cart) {
  const Regulation task = regulationOf(plantOf(cart), costsOfTheSheet());
  const Eigen::MatrixXd start = -task.optimal.K;
  const double bound = start.cwiseAbs().maxCoeff();
  const double least =
      rex::fastestGains({.A = task.plant.A, .B = task.plant.B}, -start, {.bound = bound}).rate;
  check.input(fmt::format("{}, bound {:g}, slowest pole of the start {:g}", described(cart), bound,
                          abscissa(task.plant.A + task.plant.B * start)));
  int asked = 0;
  const auto slowest = [&](const Eigen::MatrixXd& K) {
    ++asked;
    if (K.rows() != 1 || K.cols() != 4 || !K.allFinite()) return 1e9;
    return abscissa(task.plant.A + task.plant.B * K);
  };
  const Eigen::MatrixXd K = student.quickGains(slowest, start, bound, check.split(7));
  check.shape("K of quickGains", K, 1, 4);
  check.atMost("number of calls of slowest() by quickGains", asked, 3000);
  check.atMost("largest entry of K of quickGains", K.cwiseAbs().maxCoeff(), bound * (1 + 1e-9));
  check.atMost("slowest pole under K of quickGains", abscissa(task.plant.A + task.plant.B * K), .5 * least,
               "1/s");
}
