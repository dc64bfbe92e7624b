#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "grading/check.h"
#include "interface.h"

// Parts 1 and 2: what must hold for J#, the projector, and the step for several tasks.

inline Eigen::MatrixXd randomMatrix(rex::Rng& rng, int rows, int columns) {
  return rng.normalVector(rows * columns).reshaped(rows, columns);
}

/// Columns that span the nullspace of J.
inline Eigen::MatrixXd nullspace(const Eigen::MatrixXd& J) {
  Eigen::MatrixXd square = Eigen::MatrixXd::Zero(std::max(J.rows(), J.cols()), J.cols());
  square.topRows(J.rows()) = J;
  const rex::SingularValues parts = rex::svd(square);
  const auto rank = (parts.s.array() > 1e-9 * parts.s[0]).count();
  return parts.V.rightCols(J.cols() - rank);
}

/// X minimises precision * |J X dy - dy|^2 + |X dy|_W^2 for every dy if this gradient vanishes.
inline void inverseIsTheMinimum(rex::grading::Check& check, Student& student, const Eigen::MatrixXd& J,
                                const Eigen::MatrixXd& W, double precision) {
  const Eigen::MatrixXd X = student.regularisedInverse(J, W, precision);
  check.shape("J# of regularisedInverse", X, J.cols(), J.rows());
  const Eigen::MatrixXd gradient =
      precision * J.transpose() * (J * X - Eigen::MatrixXd::Identity(J.rows(), J.rows())) + W * X;
  const Eigen::MatrixXd wanted = rex::solve(precision * J.transpose() * J + W, precision * J.transpose());
  const double scale = (precision * J.squaredNorm() + W.norm()) * wanted.norm() + precision * J.norm();
  check.atMost("gradient of the cost at dq = J# dy, with J# of regularisedInverse, relative",
               gradient.norm() / scale, 1e-8);
}

inline void isTheProjector(rex::grading::Check& check, Student& student, const Eigen::MatrixXd& J, int rank) {
  const Eigen::Index n = J.cols();
  const Eigen::MatrixXd N = student.nullspaceProjector(J);
  check.shape("N of nullspaceProjector", N, n, n);
  const Eigen::MatrixXd free = nullspace(J);
  const auto limit = check.ask("Is the precision only large where N is the limit for an infinite one?",
                               (N - free * free.transpose()).cwiseAbs().maxCoeff() < 1e-2);
  const bool isOther =
      (N * N - N).cwiseAbs().maxCoeff() < 1e-6 && std::abs(N.trace() - static_cast<double>(n - rank)) > 0.5;
  const auto zeros = check.ask("Which singular values count as zero? Those below 1e-9 of the largest.",
                               isOther && (!N.isIdentity() || J.cwiseAbs().maxCoeff() < 1e-3));
  check.atMost("largest entry of J N of nullspaceProjector, relative to J",
               (J * N).cwiseAbs().maxCoeff() / J.cwiseAbs().maxCoeff(), 1e-9);
  check.near("trace of N of nullspaceProjector, the number of free directions", N.trace(),
             static_cast<double>(n) - rank, 1e-9);
  check.near("N N, with N of nullspaceProjector", N * N, N, 1e-9);
  check.atMost("largest entry of N - N', with N of nullspaceProjector (W is the identity)",
               (N - N.transpose()).cwiseAbs().maxCoeff(), 1e-9);
}

/// The step that minimises the sum of the costs.
inline Eigen::VectorXd weightedStep(const std::vector<TaskTerm>& tasks, const Eigen::MatrixXd& W) {
  Eigen::MatrixXd H = W;
  Eigen::VectorXd pull = Eigen::VectorXd::Zero(W.rows());
  for (const auto& [error, J, precision] : tasks) {
    H += precision * J.transpose() * J;
    pull -= precision * J.transpose() * error;
  }
  return rex::solve(H, pull);
}

inline void stepIsTheMinimum(rex::grading::Check& check, Student& student, const std::vector<TaskTerm>& tasks,
                             const Eigen::MatrixXd& W) {
  const Eigen::VectorXd dq = student.multiTaskStep(tasks, W);
  check.shape("dq of multiTaskStep", dq, W.rows(), 1);
  const Eigen::VectorXd wanted = weightedStep(tasks, W);
  Eigen::VectorXd gradient = W * dq;
  double scale = W.norm() * wanted.norm();
  for (const auto& [error, J, precision] : tasks) {
    gradient += precision * J.transpose() * (error + J * dq);
    scale += precision * (J.norm() * error.norm() + J.squaredNorm() * wanted.norm());
  }
  check.atMost("gradient of the cost at dq of multiTaskStep, relative", gradient.norm() / scale, 1e-8);
}
