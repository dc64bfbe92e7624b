#include "control/riccati.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <numeric>
#include <optional>
#include <vector>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/QR>
#include <Eigen/SVD>
#include <fmt/format.h>

#include "base/error.h"
#include "control/care_doubling_internal.h"
#include "control/controllability.h"
#include "control/require_internal.h"
#include "control/stability.h"
#include "control/stability_internal.h"

extern "C" {
void dgges_(const char* wantLeft, const char* wantRight, const char* sort,
            int (*select)(const double*, const double*, const double*), const int* n, double* A,
            const int* lda, double* B, const int* ldb, int* selected, double* alphaReal,
            double* alphaImaginary, double* beta, double* left, const int* ldl, double* right, const int* ldr,
            double* work, const int* workSize, int* flags, int* info);
void dtgsen_(const int* job, const int* wantLeft, const int* wantRight, const int* select, const int* n,
             double* A, const int* lda, double* B, const int* ldb, double* alphaReal, double* alphaImaginary,
             double* beta, double* left, const int* ldl, double* right, const int* ldr, int* selected,
             double* pl, double* pr, double* dif, double* work, const int* workSize, int* integers,
             const int* integerSize, int* info);
}

namespace rex {
namespace {

using internal::ExtendedMatrix;

enum class Kind { kContinuous, kDiscrete };

// Tolerances are relative unless stated otherwise, in the units in which the largest entries are about one
// (see Units). No result of the tests changes with ten times or a tenth of any one of them, 0.5 to 1.05 times
// kWorthBalancing, or 0.1 to 0.9 for kStepMustShrinkTo.
constexpr double kTiny = 1e-300;  // absolute, against division by zero
// R may be singular in discrete time: an eigenvalue this little below zero is rounding.
constexpr double kSemidefinite = 1e-9;
// Balancing goes on while it shrinks a row and column by a twentieth, as in LAPACK's dgebal.
constexpr double kWorthBalancing = 0.95;
constexpr int kMostBalancingRounds = 1000;
// R + B^T X B with a smaller reciprocal condition loses all digits of K: 500 times the rounding of doubles.
constexpr double kSingularWeight = 1e-13;
// Newton's steps shrink quadratically, so one that is not even halved shows that rounding dominates, or that
// an eigenvalue is double. Residuals may grow a little at the end; steps of 1e-18 change no digit.
constexpr int kMostNewtonSteps = 10;
constexpr double kStepMustShrinkTo = 0.5, kResidualMayGrowTo = 2, kSettled = 1e-18;
// What counts as a solution, whose residual is near 1e-18 in extended precision. A last step above kConverged
// belongs to a double eigenvalue, where Newton's steps only halve the error.
constexpr double kResidualOfSolution = 1e-10, kConverged = 1e-9;
// Rounding moves double eigenvalues by 1e-8, the square root of 1e-16.
constexpr double kNearEdge = 1e-8, kDoubtOfRate = 1e-7, kDoubtOfFactor = 1e-9;
// Below this, Hautus' matrix has lost its rank, as far as n rows of doubles can show.
constexpr double kRankLost = 1e-9;
// Only for messages: an eigenvalue of the pencil that counts as on the imaginary axis, or the unit circle.
constexpr double kOnEdge = 1e-6;
// Only closer to the edge than this are hidden modes looked for, which costs as much as the solution.
constexpr double kWorthALook = 1e-3;

struct Problem {
  Kind kind;
  Eigen::MatrixXd A, B, Q, R;
  double rate = 1;  // the unit of its eigenvalues
};

void requireSound(const Problem& problem) {
  const Eigen::Index n = problem.A.rows(), m = problem.B.cols();
  if (n == 0 || m == 0) throw Error({.what = "Riccati equation", .found = "no state or no control"});
  requireSize("columns of A", problem.A.cols(), n);
  requireSize("rows of B", problem.B.rows(), n);
  internal::requireFiniteMatrix("A", problem.A);
  internal::requireFiniteMatrix("B", problem.B);
  internal::requireSymmetric("Q", problem.Q, n);
  internal::requireSymmetric("R", problem.R, m);
  if (problem.kind == Kind::kContinuous) return internal::requirePositiveDefinite("R", problem.R);
  const double least =
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(problem.R, Eigen::EigenvaluesOnly).eigenvalues()[0];
  if (least < -kSemidefinite * problem.R.cwiseAbs().maxCoeff())
    throw Error({.what = "matrix R",
                 .found = fmt::format("the eigenvalue {:.6g}", least),
                 .wanted = "no negative eigenvalue"});
}

// Exponents of two: in these units of time, controls and cost, the largest entries are about one. So the size
// of the numbers does not matter, not even when they are squared.
struct Units {
  int time = 0;     // A 2^-time; even
  int control = 0;  // R 4^-control
  int cost = 0;     // X 4^-cost
};

Eigen::MatrixXd scaled(const Eigen::MatrixXd& M, int exponent) {
  return M.unaryExpr([exponent](double x) { return std::ldexp(x, exponent); });
}

Units unitsOf(const Problem& problem) {
  const auto exponentOf = [](const Eigen::MatrixXd& M) { return std::ilogb(M.cwiseAbs().maxCoeff()); };
  const bool hasB = !problem.B.isZero(0), hasQ = !problem.Q.isZero(0);
  Units units;
  if (!problem.R.isZero(0)) units.control = exponentOf(problem.R) / 2;
  const int q = hasQ ? exponentOf(problem.Q) : 0, b = hasB ? exponentOf(problem.B) - units.control : 0;
  units.cost = hasQ && hasB ? (q - 2 * b) / 4 : hasQ ? q / 2 : -b;
  if (problem.kind == Kind::kDiscrete) return units;
  constexpr int kNone = -10000;
  const int a = problem.A.isZero(0) ? kNone : exponentOf(problem.A),
            ofB = hasB ? 2 * (b + units.cost) : kNone, ofQ = hasQ ? q - 2 * units.cost : kNone;
  if (const int most = std::max({a, ofB, ofQ}); most != kNone) units.time = most / 2 * 2;
  return units;
}

Problem inUnits(const Problem& problem, const Units& units) {
  return {problem.kind,
          scaled(problem.A, -units.time),
          scaled(problem.B, units.cost - units.control - units.time / 2),
          scaled(problem.Q, -2 * units.cost - units.time),
          scaled(problem.R, -2 * units.control),
          std::ldexp(1., units.time)};
}

// The matrix pencil whose stable deflating subspace gives X, of size 2 n + m, with its columns and rows
// scaled alike so that large numbers do not swamp small ones. The scaling of the first n columns is undone at
// the end.
struct Pencil {
  Eigen::MatrixXd H, J;
  Eigen::VectorXd scale;  // of the states: X = diag(scale) X' diag(scale)
};

Pencil pencilOf(const Problem& problem) {
  const Eigen::Index n = problem.A.rows(), m = problem.B.cols(), size = 2 * n + m;
  Pencil pencil{Eigen::MatrixXd::Zero(size, size), Eigen::MatrixXd::Zero(size, size), {}};
  Eigen::MatrixXd &H = pencil.H, &J = pencil.J;
  H.topLeftCorner(n, n) = problem.A;
  H.topRightCorner(n, m) = problem.B;
  H.block(n, 0, n, n) = -problem.Q;
  H.bottomRightCorner(m, m) = problem.R;
  J.topLeftCorner(n, n).setIdentity();
  if (problem.kind == Kind::kContinuous) {
    H.block(n, n, n, n) = -problem.A.transpose();
    H.block(2 * n, n, m, n) = problem.B.transpose();
    J.block(n, n, n, n).setIdentity();
  } else {
    H.block(n, n, n, n).setIdentity();
    J.block(n, n, n, n) = problem.A.transpose();
    J.block(2 * n, n, m, n) = -problem.B.transpose();
  }
  return pencil;
}

// Powers of two, so that nothing is rounded; states and costates get inverse factors, which keeps the
// structure.
void balance(Pencil& pencil, Eigen::Index n) {
  const Eigen::Index size = pencil.H.rows();
  Eigen::MatrixXd M = pencil.H.cwiseAbs() + pencil.J.cwiseAbs();
  M.diagonal().setZero();
  Eigen::VectorXd factors = Eigen::VectorXd::Ones(size);
  bool changed = true;
  for (int round = 0; changed && round < kMostBalancingRounds;
       ++round) {  // Osborne 1960, as in LAPACK's dgebal
    changed = false;
    for (Eigen::Index i = 0; i < size; ++i) {
      const Eigen::VectorXd ofColumn = M.col(i), ofRow = M.row(i);
      const double column = ofColumn.stableNorm(), row = ofRow.stableNorm();
      if (column == 0 || row == 0) continue;
      const double factor = std::exp2(std::round(0.5 * (std::log2(row) - std::log2(column))));
      if (!(factor * column + row / factor < kWorthBalancing * (column + row))) continue;
      changed = true;
      factors[i] *= factor;
      M.col(i) *= factor;
      M.row(i) /= factor;
    }
  }
  Eigen::VectorXd powers(size);
  const Eigen::VectorXd logs = factors.array().log() / std::log(2.);
  powers.head(n) = ((logs.head(n) - logs.segment(n, n)) / 2).array().round();
  powers.segment(n, n) = -powers.head(n);
  powers.tail(size - 2 * n) = logs.tail(size - 2 * n).array().round();
  const Eigen::VectorXd scale = powers.unaryExpr([](double p) { return std::exp2(p); });
  pencil.H = scale.cwiseInverse().asDiagonal() * pencil.H * scale.asDiagonal();
  pencil.J = scale.cwiseInverse().asDiagonal() * pencil.J * scale.asDiagonal();
  pencil.scale = scale.head(n).cwiseInverse();
}

double instability(Kind kind, std::complex<double> value) {
  return internal::instability(value, kind == Kind::kDiscrete);
}

// The n most stable right deflating vectors of (H, J), 2 n x n; empty if LAPACK gives up or a pair of
// conjugate eigenvalues would have to be split. `border` is the least stable of their eigenvalues.
Eigen::MatrixXd stableSubspace(Kind kind, Eigen::MatrixXd H, Eigen::MatrixXd J,
                               std::optional<std::complex<double>>& border) {
  const int size = static_cast<int>(H.rows()), one = 1, workSize = 100 * size + 200;
  Eigen::MatrixXd Z(size, size);
  Eigen::VectorXd real(size), imaginary(size), beta(size), work(workSize);
  std::vector<int> flags(static_cast<std::size_t>(size));
  double none = 0;
  int selected = 0, info = 0;
  dgges_("N", "V", "N", nullptr, &size, H.data(), &size, J.data(), &size, &selected, real.data(),
         imaginary.data(), beta.data(), &none, &one, Z.data(), &size, work.data(), &workSize, flags.data(),
         &info);
  if (info != 0) return {};
  std::vector<int> order(static_cast<std::size_t>(size)), select(static_cast<std::size_t>(size), 0);
  std::iota(order.begin(), order.end(), 0);
  const auto key = [&](int i) {
    return beta[i] == 0 ? std::numeric_limits<double>::infinity()
                        : instability(kind, std::complex<double>(real[i], imaginary[i]) / beta[i]);
  };
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return key(a) < key(b); });
  const int last = order[static_cast<std::size_t>(size / 2 - 1)];
  if (beta[last] != 0) border = std::complex<double>(real[last], imaginary[last]) / beta[last];
  for (int i = 0; i < size / 2; ++i) select[static_cast<std::size_t>(order[static_cast<std::size_t>(i)])] = 1;
  for (int i = 0; i + 1 < size; ++i)
    if (imaginary[i] > 0 && select[static_cast<std::size_t>(i)] != select[static_cast<std::size_t>(i) + 1])
      return {};
  const int job = 0, wantLeft = 0, wantRight = 1, integerSize = size + 6;
  std::vector<int> integers(static_cast<std::size_t>(integerSize));
  double pl = 0, pr = 0, dif[2] = {0, 0};
  dtgsen_(&job, &wantLeft, &wantRight, select.data(), &size, H.data(), &size, J.data(), &size, real.data(),
          imaginary.data(), beta.data(), &none, &one, Z.data(), &size, &selected, &pl, &pr, dif, work.data(),
          &workSize, integers.data(), &integerSize, &info);
  if (info != 0) return {};
  return Z.leftCols(size / 2);
}

std::optional<Eigen::MatrixXd> bySchurForm(const Problem& problem,
                                           std::optional<std::complex<double>>& border) {
  const Eigen::Index n = problem.A.rows(), m = problem.B.cols();
  Pencil pencil = pencilOf(problem);
  balance(pencil, n);
  if (!pencil.H.allFinite() || !pencil.J.allFinite()) return {};
  // The controls are eliminated by what is orthogonal to their columns.
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(pencil.H.rightCols(m));
  const Eigen::MatrixXd rest = Eigen::MatrixXd(qr.householderQ()).rightCols(2 * n).transpose(),
                        H = pencil.H.leftCols(2 * n), J = pencil.J.leftCols(2 * n);
  const Eigen::MatrixXd U = stableSubspace(problem.kind, rest * H, rest * J, border);
  if (U.size() == 0) return {};
  const Eigen::MatrixXd upperT = U.topRows(n).transpose(), lowerT = U.bottomRows(n).transpose();
  const Eigen::PartialPivLU<Eigen::MatrixXd> upper(upperT);
  if (!(upper.rcond() > kTiny)) return {};
  const Eigen::MatrixXd X = upper.solve(lowerT);
  const Eigen::MatrixXd scaled = pencil.scale.asDiagonal() * X * pencil.scale.asDiagonal();
  if (!scaled.allFinite()) return {};
  return Eigen::MatrixXd(0.5 * (scaled + scaled.transpose()));
}

// Without a cost and with nothing to stabilize, X is exactly zero: a relative residual would not recognize
// it.
std::optional<Eigen::MatrixXd> startOf(const Problem& problem, std::optional<std::complex<double>>& border) {
  const auto stability = problem.kind == Kind::kDiscrete ? discreteStability : continuousStability;
  if (problem.Q.isZero(0) && stability(problem.A).stability == Stability::kAsymptotic)
    return Eigen::MatrixXd::Zero(problem.A.rows(), problem.A.rows()).eval();
  return bySchurForm(problem, border);
}

// R + B^T X B, whatever the units of the controls.
bool hasSingularWeight(const Problem& problem, const Eigen::MatrixXd& X) {
  const Eigen::MatrixXd weight = problem.R + problem.B.transpose() * X * problem.B;
  const Eigen::VectorXd sizes = weight.cwiseAbs().rowwise().maxCoeff();
  if (!(sizes.minCoeff() > 0)) return true;
  const Eigen::VectorXd scale = sizes.cwiseSqrt().cwiseInverse();
  return !(Eigen::PartialPivLU<Eigen::MatrixXd>(scale.asDiagonal() * weight * scale.asDiagonal()).rcond() >
           kSingularWeight);
}

// The residual of the equation at X, and the gain there, in extended precision; X may be a sum of two
// doubles.
struct Residual {
  Eigen::MatrixXd value, K;
  double size;  // of the value, relative to the largest term
};
Residual residualAt(const Problem& problem, const ExtendedMatrix& X) {
  const ExtendedMatrix A(problem.A), B(problem.B), Q(problem.Q), XB = product(X, B);
  const bool isContinuous = problem.kind == Kind::kContinuous;
  ExtendedMatrix weight(problem.R);
  if (!isContinuous) weight += transposedProduct(B, XB);
  const ExtendedMatrix K = solved(weight, isContinuous ? XB.transpose() : transposedProduct(XB, A));
  const ExtendedMatrix quadratic = transposedProduct(K, product(weight, K));
  ExtendedMatrix value = isContinuous ? product(X, A) : transposedProduct(A, product(X, A));
  if (isContinuous)
    value += transposedProduct(A, X);
  else
    value -= X;
  value -= quadratic;
  value += Q;
  const double largest =
      static_cast<double>(std::max({X.norm() * (isContinuous ? A.norm() : 1), quadratic.norm(), Q.norm()}));
  const double size = static_cast<double>(value.norm()) / std::max(largest, kTiny);
  value += value.transpose();
  return {0.5 * value.rounded(), K.rounded(), size};
}

struct Refined {
  ExtendedMatrix X;
  double lastStep;  // relative; infinite if there was none
};

// Newton's steps (Kleinman 1968): each solves a Lyapunov equation of the closed loop.
Refined refined(const Problem& problem, const Eigen::MatrixXd& start) {
  double before = std::numeric_limits<double>::infinity();
  Refined result{ExtendedMatrix(start), before};
  Residual here = residualAt(problem, result.X);
  for (int i = 0; i < kMostNewtonSteps; ++i) {
    const Eigen::MatrixXd closed = problem.A - problem.B * here.K;
    Eigen::MatrixXd step;
    try {
      step = problem.kind == Kind::kContinuous ? solveLyapunov(closed, here.value)
                                               : solveDiscreteLyapunov(closed, here.value);
    } catch (const Error&) {
      return result;  // the closed loop is on the boundary
    }
    const double size = step.norm();
    result.lastStep = size / std::max(static_cast<double>(result.X.norm()), kTiny);
    if (!(size < kStepMustShrinkTo * before)) return result;
    ExtendedMatrix next = result.X;
    next += ExtendedMatrix(step);
    const Residual there = residualAt(problem, next);
    if (!(there.size <= kResidualMayGrowTo * here.size)) return result;
    result.X = next;
    here = there;
    before = size;
    if (result.lastStep <= kSettled) break;
  }
  return result;
}

// A nearly unstable eigenvalue of A for which [A - lambda, B] (or its dual) is nearly rank deficient: Hautus'
// test. With `mayGrow`, growing modes do no harm: the cost need not see them.
std::optional<std::complex<double>> badMode(const Problem& problem, const Eigen::MatrixXd& A,
                                            const Eigen::MatrixXd& B, bool mayGrow) {
  const Eigen::Index n = A.rows();
  const Eigen::VectorXcd eigenvalues = Eigen::EigenSolver<Eigen::MatrixXd>(A, false).eigenvalues();
  const double scale = std::max(A.norm(), kTiny);
  const double near = kNearEdge * (problem.kind == Kind::kContinuous ? scale : 1);
  for (const std::complex<double> lambda : eigenvalues) {
    const double margin = instability(problem.kind, lambda);
    if (margin < -near || (mayGrow && margin > near)) continue;
    Eigen::MatrixXcd hautus(n, n + B.cols());
    hautus << A - lambda * Eigen::MatrixXcd::Identity(n, n),
        B.cast<std::complex<double>>() * (scale / std::max(B.norm(), kTiny));
    if (internal::singularValues(hautus)[n - 1] <= kRankLost * scale) return lambda;
  }
  return {};
}

// Modes that B does not move at all, found from the structure, which also works for stiff systems. The closed
// loop leaves them as they are.
struct HiddenModes {
  std::optional<std::complex<double>> growing, onEdge;
};
HiddenModes hiddenModes(const Problem& problem, const Eigen::MatrixXd& A, const Eigen::MatrixXd& B) {
  const ReachableStates states = controllability({.A = A, .B = B});
  const Eigen::MatrixXd block = states.unreachable.transpose() * A * states.unreachable;
  const bool isDiscrete = problem.kind == Kind::kDiscrete;
  HiddenModes found;
  for (const HiddenMode& mode : states.modes) {
    const bool isOnEdge = internal::distanceToEdge(block, mode.eigenvalue, isDiscrete) <=
                          internal::roundingOf(A.rows(), A.norm());
    if (isOnEdge)
      found.onEdge = mode.eigenvalue;
    else if (internal::instability(mode.eigenvalue, isDiscrete) > 0)
      found.growing = mode.eigenvalue;
  }
  return found;
}

// A mode that keeps the equation from having a stabilizing solution.
std::optional<std::complex<double>> unreachableMode(const Problem& problem) {
  const HiddenModes modes = hiddenModes(problem, problem.A, problem.B);
  return modes.growing ? modes.growing : modes.onEdge;
}
std::optional<std::complex<double>> unseenMode(const Problem& problem) {
  return hiddenModes(problem, problem.A.transpose(), problem.Q).onEdge;
}

std::string textOf(const Problem& problem, std::complex<double> eigenvalue) {
  return internal::eigenvalueText(eigenvalue * problem.rate);
}

const char* edgeOf(const Problem& problem) {
  return problem.kind == Kind::kContinuous ? "imaginary axis" : "unit circle";
}

// Every direction of u must cost or move something.
bool hasIdleControl(const Problem& problem) {
  Eigen::MatrixXd effects(problem.B.rows() + problem.R.rows(), problem.B.cols());
  effects << problem.B, problem.R;
  for (auto effect : effects.colwise()) {
    if (effect.isZero(0)) return true;
    effect.stableNormalize();
  }
  return effects.colPivHouseholderQr().rank() < effects.cols();
}

// Only explains what went wrong: with entries of very different size the tests themselves may err. `border`
// is the least stable eigenvalue that X would keep.
RiccatiResult explained(const Problem& problem, const std::optional<std::complex<double>>& border,
                        const std::string& otherwise) {
  const auto failed = [&](RiccatiStatus status, std::optional<std::complex<double>> mode,
                          std::string message) {
    RiccatiResult result{.status = status, .mode = mode};
    result.message = std::move(message);
    return result;
  };
  auto mode = unreachableMode(problem);
  if (mode || (mode = badMode(problem, problem.A, problem.B, false)))
    return failed(
        RiccatiStatus::kNotStabilizable, mode,
        "not stabilizable: the control cannot reach the mode of eigenvalue " + textOf(problem, *mode));
  mode = unseenMode(problem);
  if (mode || (mode = badMode(problem, problem.A.transpose(), problem.Q, true)))
    return failed(RiccatiStatus::kNotDetectable, mode,
                  "not detectable: the cost does not see the mode of eigenvalue " + textOf(problem, *mode));
  if (problem.kind == Kind::kDiscrete && hasIdleControl(problem))
    return failed(
        RiccatiStatus::kFailed, {},
        "no solution: R + B^T X B is singular for every X: some control neither moves nor costs anything");
  if (border && std::abs(instability(problem.kind, *border)) < kOnEdge * std::max(1., std::abs(*border)))
    return failed(
        RiccatiStatus::kFailed, border,
        fmt::format("no stabilizing solution: the equation's pencil has the eigenvalue {} on the {}",
                    textOf(problem, *border), edgeOf(problem)));
  return failed(RiccatiStatus::kFailed, {}, otherwise);
}

std::string solvedMessage(const RiccatiResult& result, double margin) {
  return fmt::format("solved: relative residual {:.2g}, closed-loop margin {:.4g}", result.residual, margin);
}

// The least stable closed-loop eigenvalue, and how far rounding may have moved it: a double one moves by the
// root.
struct Margin {
  double instability = -std::numeric_limits<double>::infinity(), doubt = 0;
};
Margin marginOf(const Problem& problem, const RiccatiResult& result, double scale) {
  Margin margin;
  for (const std::complex<double> lambda : result.closedLoop) {
    const double here = instability(problem.kind, lambda);
    if (here <= margin.instability) continue;
    margin.instability = here;
    margin.doubt =
        std::max(problem.kind == Kind::kContinuous ? kDoubtOfRate * std::abs(lambda) : kDoubtOfFactor,
                 internal::roundingOf(problem.A.rows(), scale));
  }
  return margin;
}

RiccatiResult solveInUnits(const Problem& problem) {
  std::optional<std::complex<double>> border;
  const auto start = startOf(problem, border);
  if (!start)
    return explained(problem, border,
                     "no stabilizing solution: the equation's pencil has no stable part that gives one");
  const Refined best = refined(problem, *start);
  const Residual at = residualAt(problem, best.X);
  if (problem.kind == Kind::kDiscrete && hasSingularWeight(problem, best.X.rounded()))
    return explained(problem, border, "no solution: R + B^T X B is singular");
  RiccatiResult result{.X = best.X.rounded(), .K = at.K, .residual = at.size};
  result.X = (0.5 * (result.X + result.X.transpose())).eval();
  const Eigen::MatrixXd feedback = problem.B * result.K, closed = problem.A - feedback;
  result.closedLoop = Eigen::EigenSolver<Eigen::MatrixXd>(closed, false).eigenvalues();
  const double scale = problem.A.norm() + feedback.norm();
  const Margin margin = marginOf(problem, result, scale);
  // Newton's last step is not small if a closed-loop eigenvalue is double in the pencil, on its boundary.
  const bool isLimit = margin.instability >= -margin.doubt || !(best.lastStep <= kConverged),
             isNearEdge = margin.instability > -kWorthALook * (problem.kind == Kind::kContinuous ? scale : 1);
  if (!(result.residual < kResidualOfSolution) || margin.instability > margin.doubt ||
      (isLimit && !isNearEdge))
    return explained(
        problem, border,
        fmt::format("no stabilizing solution was found: relative residual {:.2g}, closed-loop margin {:.2g}",
                    at.size, -margin.instability * problem.rate));
  // An X for a mode that nothing moves is not a solution, however small its residual.
  if (isNearEdge && (unreachableMode(problem) || unseenMode(problem))) return explained(problem, border, "");
  if (isLimit && (badMode(problem, problem.A, problem.B, false) ||
                  badMode(problem, problem.A.transpose(), problem.Q, true)))
    return explained(problem, border, "");
  result.status = isLimit ? RiccatiStatus::kOnBoundary : RiccatiStatus::kSolved;
  result.message =
      isLimit ? fmt::format(
                    "closed-loop eigenvalues lie on the {}: X is the limit of stabilizing solutions, to "
                    "about half the digits",
                    edgeOf(problem))
              : solvedMessage(result, -margin.instability * problem.rate);
  return result;
}

RiccatiResult solve(const Problem& given) {
  const Units units = unitsOf(given);
  const Problem problem = inUnits(given, units);
  RiccatiResult result = solveInUnits(problem);
  if (result.mode) *result.mode *= problem.rate;
  if (result.X.size() == 0) return result;
  result.X = scaled(result.X, 2 * units.cost);
  result.K = scaled(result.K, units.cost - units.control + units.time / 2);
  result.closedLoop *= problem.rate;
  if (result.X.allFinite() && result.K.allFinite()) return result;
  return {.message = "no solution: X has entries too large for a double"};
}

// A growing mode that the cost does not see is stabilized all the same, although that does not cost least.
void noteUnseenGrowth(const Problem& problem, RiccatiResult& result) {
  if (result.status != RiccatiStatus::kSolved ||
      Eigen::LLT<Eigen::MatrixXd>(problem.Q).info() == Eigen::Success)
    return;
  result.mode = hiddenModes(problem, problem.A.transpose(), problem.Q).growing;
  if (result.mode)
    result.message += fmt::format(
        "; not detectable: the cost does not see the growing mode of eigenvalue {}, "
        "so X is not the least cost, but the cost of stabilizing it",
        internal::eigenvalueText(*result.mode));
}

}  // namespace

RiccatiResult solveCare(const MatrixArg& A, const MatrixArg& B, const MatrixArg& Q, const MatrixArg& R) {
  const Problem problem{Kind::kContinuous, A, B, Q, R};
  requireSound(problem);
  RiccatiResult result;
  if (auto quick = internal::careByDoubling(A, B, Q, R)) {
    quick->message = solvedMessage(*quick, -quick->closedLoop.real().maxCoeff());
    result = std::move(*quick);
  } else {
    result = solve(problem);
  }
  noteUnseenGrowth(problem, result);
  return result;
}

RiccatiResult solveDare(const MatrixArg& A, const MatrixArg& B, const MatrixArg& Q, const MatrixArg& R) {
  const Problem problem{Kind::kDiscrete, A, B, Q, R};
  requireSound(problem);
  RiccatiResult result = solve(problem);
  noteUnseenGrowth(problem, result);
  return result;
}

}  // namespace rex
