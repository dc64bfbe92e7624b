#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cart_checks.h"
#include "control/gain_search.h"
#include "grading/check.h"
#include "interface.h"
#include "plants.h"

// Parts 2, 6 and 8: what must hold for P and for gains.

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

inline void iterationFits(rex::grading::Check& check, Student& student, const Regulation& task,
                          double epsilon, double tolerance) {
  const auto& [plant, costs, optimal] = task;
  const int steps = stepsUntil(plant, costs, epsilon, tolerance, 100000);
  check.input(fmt::format("{}, epsilon = {:g}, tolerance {:g}, most = {}", described(plant), epsilon,
                          tolerance, steps + 1));
  const std::optional<Eigen::MatrixXd> P = student.iterated(plant, costs, epsilon, tolerance, steps + 1);
  check.that("the iteration converges within the steps it needs", P.has_value());
  check.shape("P", *P, plant.A.rows(), plant.A.rows());
  const double size = imbalance(plant, costs, *P).lpNorm<Eigen::Infinity>();
  check.atMost("largest entry of the bracket", size, tolerance * 1.001);
  check.atLeast("largest entry of the bracket for the first P within the tolerance", size, tolerance * .8);
  check.near("P", *P, optimal.X, 1e-3 * (1 + optimal.X.norm()));
  check.that("no P if `most` is two steps too few",
             !student.iterated(plant, costs, epsilon, tolerance, steps - 2));
}

/// A = 0, B = (1, 0), Q = I: the control cannot move the second state, so its costs never end.
inline void iterationEnds(rex::grading::Check& check, Student& student) {
  const Plant plant{Eigen::MatrixXd::Zero(2, 2), Eigen::Vector2d(1, 0)};
  check.input("A = 0, B = (1, 0), Q = I, R = 1, epsilon = 0.01");
  const Costs costs{Eigen::MatrixXd::Identity(2, 2), Eigen::MatrixXd::Identity(1, 1)};
  check.that("no P if none exists", !student.iterated(plant, costs, .01, 1e-3, 5000));
}

inline void hamiltonianFits(rex::grading::Check& check, Student& student, const Regulation& task) {
  const auto& [plant, costs, optimal] = task;
  check.input(described(plant));
  const Eigen::MatrixXd P = student.viaHamiltonian(plant, costs);
  check.shape("P", P, plant.A.rows(), plant.A.rows());
  const double scale = 1 + costs.Q.norm() + 2 * (optimal.X * plant.A).norm();
  check.near("P, transposed", P.transpose(), P, 1e-9 * optimal.X.norm());
  check.near("the bracket", imbalance(plant, costs, P), Eigen::MatrixXd::Zero(P.rows(), P.cols()),
             1e-8 * scale);
  check.atMost("slowest pole of the closed loop",
               abscissa(plant.A - plant.B * rex::solve(costs.R, Eigen::MatrixXd(plant.B.transpose() * P))), 0,
               "1/s");
}

inline void gainsFit(rex::grading::Check& check, Student& student, const Regulation& task) {
  const auto& [plant, costs, optimal] = task;
  check.input(described(plant));
  check.near("K", student.gainOf(plant, costs, optimal.X), -optimal.K, 1e-8 * (1 + optimal.K.norm()));
}

/// The same for the cart of the sheet, with its motion.
inline void gainsOfTheSheetFit(rex::grading::Check& check, Student& student) {
  const auto [plant, costs, optimal] = regulationOf(plantOf({}), costsOfTheSheet());
  check.input(described(plant));
  const Eigen::MatrixXd K = student.gainOf(plant, costs, optimal.X), wanted = -optimal.K;
  check.shape("K", K, 1, 4);
  const auto shown = check.show([&] { return seenUnder(K, wanted); });
  check.near("K", K, wanted, 1e-8 * (1 + wanted.norm()));
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
  const Eigen::MatrixXd K = student.quickGains(slowest, start, bound, check.rng().split(7));
  check.shape("K", K, 1, 4);
  check.atMost("number of calls of slowest()", asked, 3000);
  check.atMost("largest entry of K, as a share of the bound", K.cwiseAbs().maxCoeff() / bound, 1 + 1e-9);
  check.atLeast("slowest pole, as a share of what the library finds",
                abscissa(task.plant.A + task.plant.B * K) / least, .5);
}

/// The first gain for a horizon of N steps, from the normal equations of the costs as a function of all
/// controls.
inline Eigen::MatrixXd firstGain(const Plant& plant, const Costs& costs, const Eigen::MatrixXd& F, int N) {
  const Eigen::Index n = plant.B.rows(), m = plant.B.cols();
  Eigen::MatrixXd fromStart = Eigen::MatrixXd::Identity(n, n);
  Eigen::MatrixXd fromControls = Eigen::MatrixXd::Zero(n, N * m);
  Eigen::MatrixXd H = Eigen::MatrixXd::Zero(N * m, N * m), G = Eigen::MatrixXd::Zero(N * m, n);
  for (int t = 0; t < N; ++t) {
    H.block(t * m, t * m, m, m) += costs.R;
    fromStart = plant.A * fromStart;
    fromControls = plant.A * fromControls;
    fromControls.middleCols(t * m, m) = plant.B;
    const Eigen::MatrixXd& weight = t + 1 < N ? costs.Q : F;
    H += fromControls.transpose() * weight * fromControls;
    G += fromControls.transpose() * weight * fromStart;
  }
  return -rex::solveMatrix(H, G).topRows(m);
}

inline void horizonFits(rex::grading::Check& check, Student& student, const Plant& plant, const Costs& costs,
                        const Eigen::MatrixXd& F, int steps) {
  check.input(fmt::format("{}, {} steps", described(plant), steps));
  const std::vector<Eigen::MatrixXd> K = student.gainsOverTime(plant, costs, F, steps);
  check.near("number of gains", static_cast<double>(K.size()), steps, 0);
  for (int t = 0; t < steps; ++t) {
    const Eigen::MatrixXd wanted = firstGain(plant, costs, F, steps - t);
    check.near(fmt::format("K[{}]", t), K[static_cast<std::size_t>(t)], wanted, 1e-7 * (1 + wanted.norm()));
  }
}
