#include "control/finite_horizon.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <fmt/format.h>
#include <unsupported/Eigen/MatrixFunctions>

#include "base/error.h"
#include "control/require_internal.h"

namespace rex {
namespace {

void requireSymmetric(const char* name, const MatrixArg& M, Eigen::Index n) {
  requireSize(fmt::format("rows of {}", name), M.rows(), n);
  requireSize(fmt::format("columns of {}", name), M.cols(), n);
  if (!M.allFinite())
    throw Error({.what = fmt::format("matrix {}", name), .found = "entries that are not finite"});
  if ((M - M.transpose()).cwiseAbs().maxCoeff() > 1e-9 * M.cwiseAbs().maxCoeff())
    throw Error({.what = fmt::format("matrix {}", name),
                 .found = "a matrix that is not symmetric",
                 .wanted = "a symmetric one"});
}

void requireSound(const LinearSystem& system, const MatrixArg& Q, const MatrixArg& R, bool isDiscrete) {
  if (system.step.has_value() != isDiscrete)
    throw Error({.what = "linear system",
                 .found = isDiscrete ? "continuous time" : "discrete time",
                 .wanted = isDiscrete ? "discrete time" : "continuous time"});
  if (system.B.cols() == 0) throw Error({.what = "linear system", .found = "no control"});
  requireSymmetric("Q", Q, system.A.rows());
  requireSymmetric("R", R, system.B.cols());
  if (isDiscrete || Eigen::LLT<Eigen::MatrixXd>(R).info() == Eigen::Success) return;
  const double least =
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(R, Eigen::EigenvaluesOnly).eigenvalues()[0];
  throw Error({.what = "matrix R",
               .found = fmt::format("the eigenvalue {:.6g}", least),
               .wanted = "a positive definite matrix"});
}

void requireSteps(int steps) {
  if (steps < 1 || steps > 10000000)
    throw Error({.what = "steps of a horizon", .found = fmt::format("{}", steps), .wanted = "1 to 10000000"});
}

Eigen::MatrixXd symmetric(const Eigen::MatrixXd& M) { return 0.5 * (M + M.transpose()); }

RiccatiHorizon failed(std::string message) { return {.message = std::move(message)}; }

RiccatiHorizon solved(std::vector<Eigen::MatrixXd> P, std::vector<Eigen::MatrixXd> K) {
  std::reverse(P.begin(), P.end());
  std::reverse(K.begin(), K.end());
  return {.isSolved = true, .P = std::move(P), .K = std::move(K), .message = "solved"};
}

}  // namespace

RiccatiHorizon discreteHorizon(const LinearSystem& given, const MatrixArg& Q, const MatrixArg& R,
                               const MatrixArg& F, int steps) {
  const LinearSystem system = completed(given);
  requireSound(system, Q, R, true);
  requireSymmetric("F", F, system.A.rows());
  requireSteps(steps);
  std::vector<Eigen::MatrixXd> P{F}, K;
  for (int t = steps - 1; t >= 0; --t) {
    const Eigen::MatrixXd PB = P.back() * system.B;
    const Eigen::LLT<Eigen::MatrixXd> weight(symmetric(R + system.B.transpose() * PB));
    if (weight.info() != Eigen::Success)
      return failed(fmt::format("step {}: R + B^T P B is not positive definite: no control is the best", t));
    K.push_back(weight.solve(PB.transpose() * system.A));
    // In this form (Joseph's) rounding leaves P positive semidefinite.
    const Eigen::MatrixXd closed = system.A - system.B * K.back();
    P.push_back(symmetric(Q + K.back().transpose() * R * K.back() + closed.transpose() * P.back() * closed));
    if (!P.back().allFinite()) return failed(fmt::format("step {}: P is not finite", t));
  }
  return solved(std::move(P), std::move(K));
}

RiccatiHorizon continuousHorizon(const LinearSystem& given, const MatrixArg& Q, const MatrixArg& R,
                                 const MatrixArg& F, double T, int steps) {
  const LinearSystem system = completed(given);
  requireSound(system, Q, R, false);
  requireSymmetric("F", F, system.A.rows());
  internal::requirePositive("time T of a horizon", T);
  requireSteps(steps);
  const Eigen::Index n = system.A.rows();
  const Eigen::LLT<Eigen::MatrixXd> weight(R);
  Eigen::MatrixXd hamiltonian(2 * n, 2 * n);
  hamiltonian << system.A, -system.B * weight.solve(system.B.transpose()), -Q, -system.A.transpose();
  // (Y; Z) moves by the Hamiltonian and P = Z Y^-1. Over short stretches, each from Y = 1 again, no part of
  // it swamps another.
  const double h = T / steps;
  const int parts = std::max(1, static_cast<int>(std::ceil(h * hamiltonian.norm())));
  const Eigen::MatrixXd flow = (-h / parts * hamiltonian).exp();
  const auto gainAt = [&](const Eigen::MatrixXd& P) -> Eigen::MatrixXd {
    return weight.solve(system.B.transpose() * P);
  };
  std::vector<Eigen::MatrixXd> P{F}, K{gainAt(F)};
  for (int i = steps - 1; i >= 0; --i) {
    Eigen::MatrixXd now = P.back();
    for (int part = 0; part < parts; ++part) {
      const Eigen::MatrixXd Y = flow.topLeftCorner(n, n) + flow.topRightCorner(n, n) * now;
      const Eigen::MatrixXd Z = flow.bottomLeftCorner(n, n) + flow.bottomRightCorner(n, n) * now;
      const Eigen::PartialPivLU<Eigen::MatrixXd> lu(Y.transpose());
      // Y starts as the identity: with its determinant's sign, P has passed through infinity.
      if (!(lu.determinant() > 0))
        return failed(fmt::format("P grows without bound before time {:.4g}", (i + 1) * h));
      now = symmetric(lu.solve(Z.transpose()));
    }
    if (!now.allFinite()) return failed(fmt::format("P is not finite at time {:.4g}", i * h));
    K.push_back(gainAt(now));
    P.push_back(std::move(now));
  }
  return solved(std::move(P), std::move(K));
}

RiccatiIteration iterateCare(const LinearSystem& given, const MatrixArg& Q, const MatrixArg& R,
                             const RiccatiIterationOptions& options) {
  const LinearSystem system = completed(given);
  requireSound(system, Q, R, false);
  internal::requirePositive("epsilon of the iteration", options.epsilon);
  internal::requirePositive("tolerance of the iteration", options.tolerance);
  if (options.maxIterations < 1)
    throw Error(
        {.what = "iterations", .found = fmt::format("{}", options.maxIterations), .wanted = "1 or more"});
  const Eigen::Index n = system.A.rows();
  const Eigen::LLT<Eigen::MatrixXd> weight(R);
  const Eigen::MatrixXd G = system.B * weight.solve(system.B.transpose());
  RiccatiIteration result{.P = Q};
  Eigen::MatrixXd change(n, n), PG(n, n);
  for (; result.iterations < options.maxIterations; ++result.iterations) {
    change.noalias() = system.A.transpose() * result.P;
    change += change.transpose().eval();
    PG.noalias() = result.P * G;
    change.noalias() -= PG * result.P;
    change += Q;
    result.residual = change.cwiseAbs().maxCoeff();
    if (!(result.residual < 1e150)) break;
    if (result.residual <= options.tolerance) {
      result.isConverged = true;
      break;
    }
    result.P += options.epsilon * change;
  }
  result.K = weight.solve(system.B.transpose() * result.P);
  result.message =
      fmt::format("{} after {} iterations: residual {:.2g}",
                  result.isConverged        ? "converged"
                  : result.residual < 1e150 ? "the iterations are spent"
                                            : "P grows without bound: epsilon is too large, or no solution",
                  result.iterations, result.residual);
  return result;
}

}  // namespace rex
