#include "control/ilqr.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "base/derivative_check.h"
#include "base/error.h"
#include "base/require.h"
#include "control/finite_horizon.h"
#include "control/require_internal.h"

namespace rex {
namespace {

constexpr double kLeastDamping = 1e-6, kMostDamping = 1e10;

struct Motion {
  Eigen::MatrixXd X, U;
  double cost = std::numeric_limits<double>::infinity();
};

double costOf(const ControlProblem& problem, const Eigen::MatrixXd& X, const Eigen::MatrixXd& U) {
  double cost = problem.final(X.col(X.cols() - 1)).squaredNorm();
  for (Eigen::Index t = 0; t < U.cols(); ++t)
    cost += problem.stage(X.col(t), U.col(t), static_cast<int>(t)).squaredNorm();
  return cost;
}

// The motion under `control`, which sees the state; its cost is infinite if the motion is not finite.
template <class Control>
Motion rolledOut(const ControlProblem& problem, Eigen::Index m, Eigen::Index N, const Control& control) {
  const Eigen::Index n = problem.start.size();
  Motion motion{.X = Eigen::MatrixXd::Zero(n, N + 1), .U = Eigen::MatrixXd::Zero(m, N)};
  motion.X.col(0) = problem.start;
  for (Eigen::Index t = 0; t < N; ++t) {
    motion.U.col(t) = control(t, motion.X.col(t));
    const Eigen::VectorXd next = problem.next(motion.X.col(t), motion.U.col(t));
    requireSize("next state", next.size(), n);
    if (!next.allFinite()) return motion;
    motion.X.col(t + 1) = next;
  }
  const double cost = costOf(problem, motion.X, motion.U);
  if (std::isfinite(cost)) motion.cost = cost;
  return motion;
}

// The problem in the differences (dx, du) from the motion.
struct Local {
  std::vector<LqStage> stages;
  Eigen::MatrixXd F;
  Eigen::VectorXd f;
};

void requireJacobian(const char* what, const Eigen::MatrixXd& J, Eigen::Index rows, Eigen::Index columns) {
  requireSize(fmt::format("rows of {}", what), J.rows(), rows);
  requireSize(fmt::format("columns of {}", what), J.cols(), columns);
  internal::requireFiniteMatrix(what, J);
}

// By x and u.
MotionJacobians costJacobians(const ControlProblem& problem, const Eigen::VectorXd& x,
                              const Eigen::VectorXd& u, int t, Eigen::Index terms) {
  if (!problem.stageDerivative)
    return {numericJacobian([&](const Eigen::VectorXd& moved) { return problem.stage(moved, u, t); }, x),
            numericJacobian([&](const Eigen::VectorXd& moved) { return problem.stage(x, moved, t); }, u)};
  MotionJacobians J = problem.stageDerivative(x, u, t);
  requireJacobian("the stage cost's derivative by x", J.A, terms, x.size());
  requireJacobian("the stage cost's derivative by u", J.B, terms, u.size());
  return J;
}

LqStage stageAround(const ControlProblem& problem, const Eigen::VectorXd& x, const Eigen::VectorXd& u,
                    int t) {
  Linearization next = linearized(problem.next, x, u, problem.derivative);
  const Eigen::VectorXd e = problem.stage(x, u, t);
  const auto [Jx, Ju] = costJacobians(problem, x, u, t, e.size());
  return {.A = std::move(next.A),
          .B = std::move(next.B),
          .Q = Jx.transpose() * Jx,
          .R = Ju.transpose() * Ju,
          .S = Ju.transpose() * Jx,
          .q = Jx.transpose() * e,
          .r = Ju.transpose() * e};
}

Local localProblem(const ControlProblem& problem, const Motion& motion) {
  Local local;
  for (Eigen::Index t = 0; t < motion.U.cols(); ++t)
    local.stages.push_back(stageAround(problem, motion.X.col(t), motion.U.col(t), static_cast<int>(t)));
  const Eigen::VectorXd last = motion.X.col(motion.X.cols() - 1);
  const Eigen::VectorXd e = problem.final(last);
  const Eigen::MatrixXd J =
      problem.finalDerivative ? problem.finalDerivative(last) : numericJacobian(problem.final, last);
  requireJacobian("the final cost's derivative", J, e.size(), last.size());
  local.F = J.transpose() * J;
  local.f = J.transpose() * e;
  return local;
}

// What the local problem promises for a step: the decrease of its quadratic cost from dx = 0.
double promise(const Local& local, const LqPolicy& policy) {
  Eigen::VectorXd x = Eigen::VectorXd::Zero(local.F.rows());
  double cost = 0;
  for (std::size_t t = 0; t < local.stages.size(); ++t) {
    const LqStage& s = local.stages[t];
    const Eigen::VectorXd u = policy.k[t] - policy.K[t] * x;
    cost += x.dot(s.Q * x) + u.dot(s.R * u) + 2 * u.dot(s.S * x) + 2 * s.q.dot(x) + 2 * s.r.dot(u);
    x = (s.A * x + s.B * u).eval();
  }
  return -(cost + x.dot(local.F * x) + 2 * local.f.dot(x));
}

void requireSound(const ControlProblem& problem, const Eigen::MatrixXd& U, const IlqrOptions& options) {
  if (!problem.next || !problem.stage || !problem.final)
    throw Error({.what = "control problem",
                 .found = "a function that is missing",
                 .wanted = "next, stage and final"});
  if (U.size() == 0) throw Error({.what = "first guess U", .found = "no controls"});
  rex::requireFinite("start of a control problem", problem.start);
  rex::requireFinite("first guess U", U.reshaped());
  requirePositive("tolerance of iLQR", options.tolerance);
  requireNotNegative("damping of iLQR", options.damping);
  requireCount("iterations of iLQR", options.maxIterations, 0);
}

// The motion after the first part of the step, of 1, 1/2, ..., that lowers the cost by a fair share of what
// it promises.
Motion lineSearch(const ControlProblem& problem, const Motion& motion, const LqPolicy& policy,
                  double promised) {
  for (double part = 1; part > 1e-4; part /= 2) {
    Motion next = rolledOut(problem, motion.U.rows(), motion.U.cols(), [&](Eigen::Index t, const auto& x) {
      const auto i = static_cast<std::size_t>(t);
      return Eigen::VectorXd(motion.U.col(t) + part * policy.k[i] - policy.K[i] * (x - motion.X.col(t)));
    });
    if (motion.cost - next.cost >= 1e-2 * part * promised) return next;
  }
  return {};
}

struct Attempt {
  LqPolicy policy;
  Motion next;  // of infinite cost if there is none
  double promised = 0;
};

// Increases the damping until a step lowers the cost or promises less than `enough`; with `isLast` no step is
// tried.
Attempt attempted(const ControlProblem& problem, const Motion& motion, double enough, bool isLast,
                  double& damping) {
  const Local local = localProblem(problem, motion);
  Attempt attempt;
  for (; damping <= kMostDamping; damping = std::max(10 * damping, kLeastDamping)) {
    attempt.policy = solveLq(local.stages, local.F, local.f, damping);
    if (!attempt.policy.isSolved) continue;
    attempt.promised = promise(local, attempt.policy);
    if (isLast || attempt.promised <= enough) break;
    attempt.next = lineSearch(problem, motion, attempt.policy, attempt.promised);
    if (std::isfinite(attempt.next.cost)) break;
  }
  return attempt;
}

std::string describe(const IlqrResult& result) {
  const char* what = result.status == IlqrStatus::kConverged     ? "converged"
                     : result.status == IlqrStatus::kBudgetSpent ? "iteration limit reached"
                     : result.status == IlqrStatus::kNoProgress  ? "no step lowers the cost"
                                                                 : "the first motion is not finite";
  return fmt::format("{} after {} steps: cost {:.6g}", what, result.iterations, result.cost);
}

}  // namespace

IlqrResult ilqr(const ControlProblem& problem, const Eigen::MatrixXd& U, const IlqrOptions& options) {
  requireSound(problem, U, options);
  Motion motion =
      rolledOut(problem, U.rows(), U.cols(), [&](Eigen::Index t, const auto&) { return U.col(t); });
  IlqrResult result;
  double damping = options.damping;
  while (std::isfinite(motion.cost)) {
    const double enough = options.tolerance * motion.cost;
    Attempt attempt = attempted(problem, motion, enough, result.iterations == options.maxIterations, damping);
    result.K = std::move(attempt.policy.K);
    result.residual = attempt.promised / std::max(motion.cost, 1e-300);
    if (!std::isfinite(attempt.next.cost)) {
      // A heavily damped step promises little anywhere.
      result.status = damping <= 1 && attempt.promised <= enough   ? IlqrStatus::kConverged
                      : result.iterations == options.maxIterations ? IlqrStatus::kBudgetSpent
                                                                   : IlqrStatus::kNoProgress;
      break;
    }
    motion = std::move(attempt.next);
    ++result.iterations;
    damping = damping > kLeastDamping ? damping / 10 : 0;
  }
  result.X = motion.X, result.U = motion.U, result.cost = motion.cost;
  result.message = describe(result);
  return result;
}

Eigen::MatrixXd followedPlan(const ControlProblem& problem, const IlqrResult& last) {
  if (last.K.empty())
    throw Error({.what = "the last plan", .found = "no policy", .wanted = "a result of ilqr()"});
  requireSize("start of a control problem", problem.start.size(), last.X.rows());
  const Eigen::Index N = last.U.cols();
  return rolledOut(problem, last.U.rows(), N,
                   [&](Eigen::Index t, const auto& x) -> Eigen::VectorXd {
                     if (t + 1 == N) return last.U.col(t);
                     return last.U.col(t + 1) -
                            last.K[static_cast<std::size_t>(t + 1)] * (x - last.X.col(t + 1));
                   })
      .U;
}

}  // namespace rex
