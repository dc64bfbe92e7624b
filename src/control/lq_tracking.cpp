#include "control/lq_tracking.h"

#include <utility>

#include <Eigen/Cholesky>
#include <fmt/format.h>

#include "base/error.h"
#include "control/require_internal.h"
#include "control/require_matrix_internal.h"

namespace rex {
namespace {

Eigen::MatrixXd orZero(const Eigen::MatrixXd& M, Eigen::Index rows, Eigen::Index columns,
                       const std::string& what) {
  if (M.size() == 0) return Eigen::MatrixXd::Zero(rows, columns);
  requireSize("rows of " + what, M.rows(), rows);
  requireSize("columns of " + what, M.cols(), columns);
  internal::requireFiniteMatrix(what, M);
  return M;
}

LqStage completed(const LqStage& stage, Eigen::Index n, std::size_t t) {
  const auto named = [t](const char* name) { return fmt::format("{} of stage {}", name, t); };
  const Eigen::Index m = stage.B.cols();
  requireSize("rows of " + named("A"), stage.A.rows(), n);
  requireSize("columns of " + named("A"), stage.A.cols(), n);
  requireSize("rows of " + named("B"), stage.B.rows(), n);
  internal::requireFiniteMatrix(named("A"), stage.A);
  internal::requireFiniteMatrix(named("B"), stage.B);
  return {.A = stage.A,
          .B = stage.B,
          .c = orZero(stage.c, n, 1, named("c")),
          .Q = orZero(stage.Q, n, n, named("Q")),
          .R = orZero(stage.R, m, m, named("R")),
          .S = orZero(stage.S, m, n, named("S")),
          .q = orZero(stage.q, n, 1, named("q")),
          .r = orZero(stage.r, m, 1, named("r"))};
}

}  // namespace

LqPolicy solveLq(const std::vector<LqStage>& stages, const Eigen::MatrixXd& F, const Eigen::VectorXd& f,
                 double damping) {
  if (stages.empty()) throw Error({.what = "linear quadratic problem", .found = "no stages"});
  const Eigen::Index n = F.rows();
  requireSize("columns of F", F.cols(), n);
  internal::requireFiniteMatrix("F", F);
  requireNotNegative("damping of a linear quadratic problem", damping);
  LqPolicy policy;
  const std::size_t N = stages.size();
  policy.K.resize(N), policy.k.resize(N), policy.P.resize(N + 1), policy.p.resize(N + 1);
  policy.P[N] = internal::symmetricPart(F);
  policy.p[N] = orZero(f, n, 1, "f");
  for (std::size_t t = N; t-- > 0;) {
    const LqStage stage = completed(stages[t], n, t);
    const Eigen::MatrixXd PA = policy.P[t + 1] * stage.A, PB = policy.P[t + 1] * stage.B;
    const Eigen::VectorXd ahead = policy.p[t + 1] + policy.P[t + 1] * stage.c;
    const Eigen::MatrixXd weight = internal::symmetricPart(stage.R + stage.B.transpose() * PB),
                          mixed = stage.S + stage.B.transpose() * PA;
    const Eigen::VectorXd slope = stage.r + stage.B.transpose() * ahead;
    Eigen::MatrixXd dampedWeight = weight;
    dampedWeight.diagonal().array() += damping;
    const Eigen::LLT<Eigen::MatrixXd> damped(dampedWeight);
    if (damped.info() != Eigen::Success)
      return {.stage = static_cast<int>(t),
              .message = fmt::format("stage {}: the cost of the control has no minimum", t)};
    const Eigen::MatrixXd& K = policy.K[t] = damped.solve(mixed);
    const Eigen::VectorXd& k = policy.k[t] = -damped.solve(slope);
    // With damping, K and k are not optimal: this form holds for any.
    const Eigen::MatrixXd P = stage.Q + stage.A.transpose() * PA + K.transpose() * weight * K -
                              K.transpose() * mixed - mixed.transpose() * K,
                          error = mixed - weight * K;
    policy.P[t] = internal::symmetricPart(P);
    policy.p[t] = stage.q + stage.A.transpose() * ahead - K.transpose() * slope + error.transpose() * k;
  }
  policy.isSolved = true;
  policy.message = "solved";
  return policy;
}

std::vector<LqStage> trackingStages(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B,
                                    const Eigen::MatrixXd& Q, const Eigen::MatrixXd& R,
                                    const Eigen::MatrixXd& path) {
  requireSize("rows of the path", path.rows(), A.rows());
  requireSize("columns of Q", Q.cols(), A.rows());
  std::vector<LqStage> stages;
  const Eigen::MatrixXd slopes = -(Q * path);
  for (Eigen::Index t = 0; t + 1 < path.cols(); ++t)
    stages.push_back({.A = A, .B = B, .Q = Q, .R = R, .q = slopes.col(t)});
  return stages;
}

}  // namespace rex
