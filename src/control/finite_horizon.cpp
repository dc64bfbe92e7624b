#include "control/finite_horizon.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <fmt/format.h>

#include "base/error.h"
#include "control/linear_system_internal.h"
#include "control/require_internal.h"

namespace rex {
namespace {

void requireSound(const LinearSystem& system, const MatrixArg& Q, const MatrixArg& R, bool isDiscrete) {
  if (system.step.has_value() != isDiscrete)
    throw Error({.what = "linear system",
                 .found = isDiscrete ? "continuous time" : "discrete time",
                 .wanted = isDiscrete ? "discrete time" : "continuous time"});
  if (system.B.cols() == 0) throw Error({.what = "linear system", .found = "no control"});
  internal::requireSymmetric("Q", Q, system.A.rows());
  internal::requireSymmetric("R", R, system.B.cols());
  if (!isDiscrete) internal::requirePositiveDefinite("R", R);
}

void requireSteps(int steps) {
  if (steps < 1 || steps > 10000000)
    throw Error({.what = "steps of a horizon", .found = fmt::format("{}", steps), .wanted = "1 to 10000000"});
}

RiccatiHorizon failed(std::string message) { return {.message = std::move(message)}; }

RiccatiHorizon solved(std::vector<Eigen::MatrixXd> P, std::vector<Eigen::MatrixXd> K) {
  std::reverse(P.begin(), P.end());
  std::reverse(K.begin(), K.end());
  return {.isSolved = true, .P = std::move(P), .K = std::move(K), .message = "solved"};
}

// The number of parts of a time, in each of which a Hamiltonian matrix moves little.
double partsOf(const Eigen::MatrixXd& hamiltonian, double time) {
  return std::max(1., std::ceil(2 * time * hamiltonian.norm()));
}

// Moves P back in time: (Y; Z) from (1; P) moves by the Hamiltonian matrix, and then P = Z Y^-1.
class HamiltonianFlow {
 public:
  HamiltonianFlow(Eigen::MatrixXd hamiltonian, double time)
      : hamiltonian_(std::move(hamiltonian)),
        parts_(static_cast<int>(partsOf(hamiltonian_, time))),
        part_(time / parts_) {}

  /// Empty where P passes through infinity.
  std::optional<Eigen::MatrixXd> moved(Eigen::MatrixXd P) {
    for (int i = 0; i < parts_; ++i) {
      std::optional<Eigen::MatrixXd> next = moved(P, 0);
      if (!next) return {};
      P = std::move(*next);
    }
    return P;
  }

 private:
  // Over part_ / 2^halvings. As long as Y stays so close to the identity it has an inverse all the way.
  std::optional<Eigen::MatrixXd> moved(const Eigen::MatrixXd& P, std::size_t halvings) {
    constexpr std::size_t kMostHalvings = 50;
    if (halvings > kMostHalvings) return {};
    while (flows_.size() <= halvings)
      flows_.push_back(
          internal::exponential(-std::ldexp(part_, -static_cast<int>(flows_.size())) * hamiltonian_));
    const Eigen::MatrixXd& flow = flows_[halvings];
    const Eigen::Index n = P.rows();
    const Eigen::MatrixXd right = flow.rightCols(n);
    Eigen::MatrixXd YZ = flow.leftCols(n);  // Y above Z
    YZ.noalias() += right * P;
    const Eigen::MatrixXd Yt = YZ.topRows(n).transpose(), Zt = YZ.bottomRows(n).transpose();
    if ((Yt - Eigen::MatrixXd::Identity(n, n)).norm() < 0.5) {
      const Eigen::MatrixXd next = Eigen::PartialPivLU<Eigen::MatrixXd>(Yt).solve(Zt);
      return internal::symmetricPart(next);
    }
    const std::optional<Eigen::MatrixXd> middle = moved(P, halvings + 1);
    return middle ? moved(*middle, halvings + 1) : std::nullopt;
  }

  Eigen::MatrixXd hamiltonian_;
  int parts_;
  double part_;
  std::vector<Eigen::MatrixXd> flows_{};
};

constexpr double kMostParts = 1e8;

// B R^-1 B^T, for the Cholesky factors of R.
Eigen::MatrixXd controlTerm(const Eigen::MatrixXd& B, const Eigen::LLT<Eigen::MatrixXd>& R) {
  const Eigen::MatrixXd Bt = B.transpose(), solution = R.solve(Bt);
  return B * solution;
}

// K = R^-1 B^T P.
Eigen::MatrixXd gainOf(const Eigen::MatrixXd& B, const Eigen::LLT<Eigen::MatrixXd>& R,
                       const Eigen::MatrixXd& P) {
  const Eigen::MatrixXd BtP = B.transpose() * P;
  return R.solve(BtP);
}

// The unit of P that makes both off-diagonal blocks of the Hamiltonian equally large.
double unitOfCost(const Eigen::MatrixXd& G, const Eigen::MatrixXd& Q) {
  const double sizeG = G.norm(), sizeQ = Q.norm();
  return sizeG > 0 && sizeQ > 0 ? std::sqrt(sizeQ) / std::sqrt(sizeG) : 1;
}

}  // namespace

RiccatiHorizon discreteHorizon(const LinearSystem& given, const MatrixArg& Q, const MatrixArg& givenR,
                               const MatrixArg& F, int steps) {
  const LinearSystem system = completed(given);
  requireSound(system, Q, givenR, true);
  internal::requireSymmetric("F", F, system.A.rows());
  requireSteps(steps);
  const Eigen::MatrixXd R = givenR;
  std::vector<Eigen::MatrixXd> P{F}, K;
  for (int t = steps - 1; t >= 0; --t) {
    const Eigen::MatrixXd PB = P.back() * system.B;
    const Eigen::LLT<Eigen::MatrixXd> weight(internal::symmetricPart(R + system.B.transpose() * PB));
    if (weight.info() != Eigen::Success)
      return failed(fmt::format("step {}: R + B^T P B is not positive definite: no control is optimal", t));
    const Eigen::MatrixXd mixed = PB.transpose() * system.A, gain = weight.solve(mixed);
    // In this form (Joseph's) rounding leaves P positive semidefinite.
    const Eigen::MatrixXd closed = system.A - system.B * gain, ofControl = gain.transpose() * R * gain,
                          ofRest = closed.transpose() * P.back() * closed;
    K.push_back(gain);
    P.push_back(internal::symmetricPart(Q + ofControl + ofRest));
    if (!P.back().allFinite()) return failed(fmt::format("step {}: P is not finite", t));
  }
  return solved(std::move(P), std::move(K));
}

RiccatiHorizon continuousHorizon(const LinearSystem& given, const MatrixArg& Q, const MatrixArg& R,
                                 const MatrixArg& F, double T, int steps) {
  const LinearSystem system = completed(given);
  requireSound(system, Q, R, false);
  internal::requireSymmetric("F", F, system.A.rows());
  requirePositive("time T of a horizon", T);
  requireSteps(steps);
  const Eigen::Index n = system.A.rows();
  const Eigen::LLT<Eigen::MatrixXd> weight{Eigen::MatrixXd(R)};
  const Eigen::MatrixXd G = controlTerm(system.B, weight);
  const double unit = unitOfCost(G, Q);
  Eigen::MatrixXd hamiltonian(2 * n, 2 * n);
  hamiltonian << system.A, -unit * G, -Q / unit, -system.A.transpose();
  const double h = T / steps;
  if (const double parts = steps * partsOf(hamiltonian, h); !(parts <= kMostParts))
    return failed(
        fmt::format("time T is too long for the fastest motion: it takes {:.2g} parts, at most {:.2g}", parts,
                    kMostParts));
  HamiltonianFlow flow(hamiltonian, h);
  std::vector<Eigen::MatrixXd> P{F}, K{gainOf(system.B, weight, F)};
  for (int i = steps - 1; i >= 0; --i) {
    const std::optional<Eigen::MatrixXd> now = flow.moved(P.back() / unit);
    if (!now) return failed(fmt::format("P grows without bound before time {:.4g}", (i + 1) * h));
    P.push_back(unit * *now);
    K.push_back(gainOf(system.B, weight, P.back()));
  }
  return solved(std::move(P), std::move(K));
}

RiccatiIteration iterateCare(const LinearSystem& given, const MatrixArg& Q, const MatrixArg& R,
                             const RiccatiIterationOptions& options) {
  const LinearSystem system = completed(given);
  requireSound(system, Q, R, false);
  requirePositive("epsilon of the iteration", options.epsilon);
  requirePositive("tolerance of the iteration", options.tolerance);
  requireCount("iterations", options.maxIterations, 1);
  const Eigen::Index n = system.A.rows();
  const Eigen::LLT<Eigen::MatrixXd> weight{Eigen::MatrixXd(R)};
  const Eigen::MatrixXd G = controlTerm(system.B, weight);
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
  result.K = gainOf(system.B, weight, result.P);
  result.message = fmt::format("{} after {} iterations: residual {:.2g}",
                               result.isConverged ? "converged"
                               : result.residual < 1e150
                                   ? "iteration limit reached"
                                   : "P grows without bound: epsilon is too large, or there is no solution",
                               result.iterations, result.residual);
  return result;
}

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
