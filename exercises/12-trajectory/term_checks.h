#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "grading/check.h"
#include "interface.h"
#include "problems.h"

// Part 1: what must hold for terms of order k.

/// The weights of x_{t-k}, ..., x_t in y, by repeated differences.
inline Eigen::VectorXd weightsOf(int k, double tau) {
  Eigen::VectorXd weights = Eigen::VectorXd::Unit(k + 1, k);
  for (int i = 0; i < k; ++i) weights.head(k) -= Eigen::VectorXd(weights.tail(k));
  return weights * std::sqrt(tau) / std::pow(tau, k);
}

/// One block of a window in J after the other.
inline Eigen::MatrixXd besideEachOther(const std::vector<TermValue>& blocks, const Eigen::VectorXd& weights) {
  const Eigen::Index n = blocks[0].J.cols();
  Eigen::MatrixXd J(blocks[0].J.rows(), n * weights.size());
  for (Eigen::Index place = 0; place < weights.size(); ++place)
    J.middleCols(place * n, n) = weights[place] * blocks[static_cast<std::size_t>(place)].J;
  return J;
}

/// The value and the Jacobian that a function returned for the values `phi` at a window.
inline void isQuotient(rex::grading::Check& check, const std::string& function, const TermValue& got,
                       const std::vector<TermValue>& phi, double tau) {
  const int k = static_cast<int>(phi.size()) - 1;
  const Eigen::VectorXd weights = weightsOf(k, tau);
  Eigen::VectorXd y = Eigen::VectorXd::Zero(phi[0].y.size());
  for (int i = 0; i <= k; ++i) y += weights[i] * phi[static_cast<std::size_t>(i)].y;
  const double tolerance = 1e-9 * weights.cwiseAbs().maxCoeff();
  check.near("y of " + function, got.y, y, tolerance);
  check.near("J of " + function, got.J, besideEachOther(phi, weights), tolerance);
}

inline void isDifference(rex::grading::Check& check, Student& student, int n, int k) {
  const double tau = check.rng().uniform(0.02, 3);
  const Eigen::MatrixXd window = randomMatrix(check.rng(), n, k + 1);
  check.input("a random window", {{"k", k}, {"tau", tau}, {"window", window}});
  std::vector<TermValue> phi;
  for (int i = 0; i <= k; ++i) phi.push_back({window.col(i), Eigen::MatrixXd::Identity(n, n)});
  isQuotient(check, "differenceTerm", student.differenceTerm(window, tau), phi, tau);
}

inline void isTaskDifference(rex::grading::Check& check, Student& student, int d, int n, int k) {
  rex::Rng& rng = check.rng();
  const double tau = rng.uniform(0.02, 3);
  std::vector<TermValue> phi;
  for (int i = 0; i <= k; ++i) phi.push_back({rng.normalVector(d), randomMatrix(rng, d, n)});
  check.input("a random task map at a window, with what it is at x_{t-k} and x_t",
              {{"k", k},
               {"tau", tau},
               {"phi.front().y", phi[0].y},
               {"phi.front().J", phi[0].J},
               {"phi.back().y", phi.back().y},
               {"phi.back().J", phi.back().J}});
  isQuotient(check, "taskDifference", student.taskDifference(phi, tau), phi, tau);
}
