#include "control/regulators.h"

#include <utility>

#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <fmt/format.h>

#include "base/error.h"
#include "base/require.h"
#include "control/require_internal.h"

namespace rex {
namespace {

void requireSemidefinite(const char* name, const MatrixArg& M, Eigen::Index n) {
  internal::requireSymmetric(name, M, n);
  const double least =
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(M, Eigen::EigenvaluesOnly).eigenvalues()[0];
  if (least < -1e-12 * M.cwiseAbs().maxCoeff())
    throw Error({.what = fmt::format("matrix {}", name),
                 .found = fmt::format("the eigenvalue {:.6g}", least),
                 .wanted = "no negative eigenvalue"});
}

RiccatiResult solve(const LinearSystem& system, const MatrixArg& Q, const MatrixArg& R) {
  return system.step ? solveDare(system.A, system.B, Q, R) : solveCare(system.A, system.B, Q, R);
}

// The statuses of the dual problem, in the terms of a filter.
SteadyKalman inWordsOfFilters(RiccatiResult dual) {
  SteadyKalman result{.status = dual.status,
                      .L = dual.K.transpose(),
                      .covariance = std::move(dual.X),
                      .closedLoop = std::move(dual.closedLoop),
                      .message = std::move(dual.message)};
  if (dual.status == RiccatiStatus::kNotStabilizable) {
    result.status = RiccatiStatus::kNotDetectable;
    result.message = fmt::format("not detectable: the measurement does not show the mode of eigenvalue {}",
                                 internal::eigenvalueText(dual.mode.value_or(0)));
  } else if (dual.status == RiccatiStatus::kNotDetectable) {
    result.status = RiccatiStatus::kNotStabilizable;
    result.message = fmt::format("not stabilizable: the noise W does not move the mode of eigenvalue {}",
                                 internal::eigenvalueText(dual.mode.value_or(0)));
  }
  return result;
}

}  // namespace

RiccatiResult lqr(const LinearSystem& given, const MatrixArg& Q, const MatrixArg& R) {
  const LinearSystem system = completed(given);
  requireSemidefinite("Q", Q, system.A.rows());
  return solve(system, Q, R);
}

SteadyKalman steadyKalman(const LinearSystem& given, const MatrixArg& W, const MatrixArg& V) {
  const LinearSystem system = completed(given);
  requireSemidefinite("W", W, system.A.rows());
  requireSemidefinite("V", V, system.C.rows());
  if (!system.step) internal::requirePositiveDefinite("V", V);
  return inWordsOfFilters(
      solve({.A = system.A.transpose(), .B = system.C.transpose(), .step = system.step}, W, V));
}

Lqg lqg(const LinearSystem& given, const MatrixArg& Q, const MatrixArg& R, const MatrixArg& W,
        const MatrixArg& V) {
  const LinearSystem system = completed(given);
  Lqg result;
  result.regulator = lqr(system, Q, R);
  result.filter = steadyKalman(system, W, V);
  const bool isRegulated = result.regulator.status == RiccatiStatus::kSolved;
  result.status = isRegulated ? result.filter.status : result.regulator.status;
  result.message =
      isRegulated ? "filter: " + result.filter.message : "regulator: " + result.regulator.message;
  if (result.status != RiccatiStatus::kSolved) return result;
  const Eigen::MatrixXd &K = result.regulator.K, &L = result.filter.L, measured = system.C - system.D * K;
  result.controller = {.A = system.A - system.B * K - L * measured,
                       .B = L,
                       .C = -K,
                       .D = Eigen::MatrixXd::Zero(K.rows(), L.cols()),
                       .step = system.step};
  return result;
}

LinearSystem closedLoop(const LinearSystem& given, const LinearSystem& givenController) {
  const LinearSystem system = completed(given), controller = completed(givenController);
  requireSize("measurements that the controller takes", controller.B.cols(), system.C.rows());
  requireSize("controls that the controller gives", controller.C.rows(), system.B.cols());
  if (system.step != controller.step || !controller.D.isZero(0))
    throw Error({.what = "closed loop",
                 .found = "a controller with a different step, or whose D is not 0",
                 .wanted = "one with the same step and D = 0"});
  const Eigen::Index n = system.A.rows(), k = controller.A.rows();
  LinearSystem loop{.A = Eigen::MatrixXd(n + k, n + k),
                    .B = Eigen::MatrixXd::Zero(n + k, system.B.cols()),
                    .C = Eigen::MatrixXd(system.C.rows(), n + k),
                    .D = system.D,
                    .step = system.step};
  loop.A << system.A, system.B * controller.C, controller.B * system.C,
      controller.A + controller.B * system.D * controller.C;
  loop.B.topRows(n) = system.B;
  loop.B.bottomRows(k) = controller.B * system.D;
  loop.C << system.C, system.D * controller.C;
  return loop;
}

RestPoint restPoint(const LinearSystem& given, const VectorArg& target) {
  const LinearSystem system = completed(given);
  const Eigen::Index n = system.A.rows(), m = system.B.cols(), p = system.C.rows();
  requireSize("target y", target.size(), p);
  requireFinite("target y", target);
  Eigen::MatrixXd conditions(n + p, n + m);
  conditions << system.A, system.B, system.C, system.D;
  if (system.step) conditions.topLeftCorner(n, n) -= Eigen::MatrixXd::Identity(n, n);
  Eigen::VectorXd wanted = Eigen::VectorXd::Zero(n + p);
  wanted.tail(p) = target;
  const Eigen::VectorXd rest = conditions.completeOrthogonalDecomposition().solve(wanted);
  return {.x = rest.head(n),
          .u = rest.tail(m),
          .isExact = (conditions * rest - wanted).norm() <=
                     1e-12 * (wanted.norm() + conditions.norm() * rest.norm())};
}

}  // namespace rex
