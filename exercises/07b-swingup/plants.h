#pragma once

#include <vector>

#include <Eigen/Eigenvalues>
#include <fmt/format.h>

#include "exercise.h"
#include "grading/check.h"
#include "interface.h"

// Part 2, and the random plants of its checks.

inline Eigen::MatrixXd randomMatrix(rex::Rng& rng, Eigen::Index rows, Eigen::Index cols) {
  return rng.normalVector(static_cast<int>(rows * cols)).reshaped(rows, cols);
}

/// Symmetric, with eigenvalues from `least` up.
inline Eigen::MatrixXd randomPositive(rex::Rng& rng, Eigen::Index n, double least) {
  const Eigen::MatrixXd root = randomMatrix(rng, n, n) / std::sqrt(static_cast<double>(n));
  return root * root.transpose() + least * Eigen::MatrixXd::Identity(n, n);
}

inline Plant randomPlant(rex::Rng& rng, Eigen::Index n, Eigen::Index m) {
  return {randomMatrix(rng, n, n) / std::sqrt(static_cast<double>(n)), randomMatrix(rng, n, m)};
}

inline double abscissa(const Eigen::MatrixXd& A) {
  return Eigen::EigenSolver<Eigen::MatrixXd>(A, false).eigenvalues().real().maxCoeff();
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
  check.input("a plant in discrete time and its costs",
              {{"A", plant.A}, {"B", plant.B}, {"Q", costs.Q}, {"R", costs.R}, {"F", F}, {"steps", steps}});
  const std::vector<Eigen::MatrixXd> K = student.gainsOverTime(plant, costs, F, steps);
  check.near("number of gains of gainsOverTime", static_cast<double>(K.size()), steps, 0);
  for (int t = 0; t < steps; ++t) {
    const int left = steps - t;
    const auto gainAfter = [&](const Eigen::MatrixXd& last) { return firstGain(plant, costs, last, 1); };
    const Eigen::MatrixXd wanted = firstGain(plant, costs, F, left), Bt = plant.B.transpose(), zero = 0 * F;
    Eigen::MatrixXd idle = F;  // what states cost if nobody controls them
    for (int k = 1; k < left; ++k) idle = costs.Q + plant.A.transpose() * idle * plant.A;
    check.near(
        fmt::format("K[{}] of gainsOverTime", t), K[static_cast<std::size_t>(t)], wanted,
        1e-7 * (1 + wanted.norm()),
        {{"Is the last state weighted with Q instead of F?", firstGain(plant, costs, costs.Q, left)},
         {"Does the last state cost nothing?", firstGain(plant, costs, zero, left)},
         {"Is the last state charged twice, with F and with Q?", firstGain(plant, costs, F + costs.Q, left)},
         {"Is Q left out on the way?", firstGain(plant, {zero, costs.R}, F, left)},
         {"Are the gains in the order of their computation? K[0] is the last of it.",
          firstGain(plant, costs, F, t + 1)},
         {"Is it always the same gain? It depends on the time that is left.",
          firstGain(plant, costs, F, steps)},
         {"Is it the gain of the step before? The P in K[t] is that after the step.",
          firstGain(plant, costs, F, left + 1)},
         {"Is it the cost of states without control that P follows?", gainAfter(idle)},
         {"Is it -R^-1 B^T P, as in continuous time?",
          left > 1 ? wanted : Eigen::MatrixXd(-rex::solveMatrix(costs.R, Bt * F))},
         {"Is B^T P B left out? R + B^T P B has to be inverted.",
          left > 1 ? wanted : Eigen::MatrixXd(-rex::solveMatrix(costs.R, Bt * F * plant.A))},
         {"Is the sign that of u = -K x? Here it is u = K x.", -wanted}});
  }
}
