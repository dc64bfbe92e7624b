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
#include "control/eigenvalue_text_internal.h"

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

using Extended = Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic>;

enum class Kind { kContinuous, kDiscrete };

struct Problem {
  Kind kind;
  Eigen::MatrixXd A, B, Q, R;
};

void requireSymmetric(const char* what, const Eigen::MatrixXd& M) {
  if ((M - M.transpose()).cwiseAbs().maxCoeff() <= 1e-9 * M.cwiseAbs().maxCoeff()) return;
  throw Error({.what = what, .found = "a matrix that is not symmetric", .wanted = "a symmetric one"});
}

double leastEigenvalue(const Eigen::MatrixXd& M) {
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(M, Eigen::EigenvaluesOnly).eigenvalues().minCoeff();
}

void requireSound(const Problem& problem) {
  const Eigen::Index n = problem.A.rows(), m = problem.B.cols();
  if (n == 0 || m == 0) throw Error({.what = "Riccati equation", .found = "no state or no control"});
  requireSize("columns of A", problem.A.cols(), n);
  requireSize("rows of B", problem.B.rows(), n);
  requireSize("rows of Q", problem.Q.rows(), n);
  requireSize("columns of Q", problem.Q.cols(), n);
  requireSize("rows of R", problem.R.rows(), m);
  requireSize("columns of R", problem.R.cols(), m);
  for (const auto& [name, M] : {std::pair{"matrix A", &problem.A},
                                {"matrix B", &problem.B},
                                {"matrix Q", &problem.Q},
                                {"matrix R", &problem.R}})
    if (!M->allFinite()) throw Error({.what = name, .found = "entries that are not finite"});
  requireSymmetric("matrix Q", problem.Q);
  requireSymmetric("matrix R", problem.R);
  const auto require = [](const char* what, double least, double bound, const char* wanted) {
    if (least < bound)
      throw Error({.what = what, .found = fmt::format("the eigenvalue {:.6g}", least), .wanted = wanted});
  };
  const double scaleR = problem.R.cwiseAbs().maxCoeff();
  if (problem.kind == Kind::kContinuous) {
    if (Eigen::LLT<Eigen::MatrixXd>(problem.R).info() != Eigen::Success)
      require("matrix R", leastEigenvalue(problem.R), std::numeric_limits<double>::infinity(),
              "a positive definite matrix");
  } else
    require("matrix R", leastEigenvalue(problem.R), -1e-9 * scaleR, "no negative eigenvalue");
}

// The matrix pencil whose stable deflating subspace gives X, of size 2 n + m, with its columns and rows
// scaled alike so that large numbers do not swamp small ones. What is done to the first n columns is undone
// at the end.
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

constexpr int kMostRounds = 1000;

// Powers of two, so that nothing is rounded; states and costates get inverse factors, which keeps the
// structure.
void balance(Pencil& pencil, Eigen::Index n) {
  const Eigen::Index size = pencil.H.rows();
  Eigen::MatrixXd M = pencil.H.cwiseAbs() + pencil.J.cwiseAbs();
  M.diagonal().setZero();
  Eigen::VectorXd factors = Eigen::VectorXd::Ones(size);
  bool changed = true;
  for (int round = 0; changed && round < kMostRounds; ++round) {  // Osborne 1960, as in LAPACK's dgebal
    changed = false;
    for (Eigen::Index i = 0; i < size; ++i) {
      const double column = M.col(i).stableNorm(), row = M.row(i).stableNorm();
      if (column == 0 || row == 0) continue;
      const double factor = std::exp2(std::round(0.5 * (std::log2(row) - std::log2(column))));
      if (!(factor * column + row / factor < 0.95 * (column + row))) continue;
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

// How far an eigenvalue is from being stable; negative when it is.
double instability(Kind kind, double real, double imaginary, double beta) {
  if (beta == 0) return std::numeric_limits<double>::infinity();
  return kind == Kind::kContinuous ? real / beta : std::hypot(real, imaginary) / std::abs(beta) - 1;
}

// The n most stable right deflating vectors of (H, J), 2 n x n; empty where LAPACK gives up, or a pair of
// conjugate eigenvalues would have to be torn apart. `border` is the least stable eigenvalue among theirs.
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
  const auto key = [&](int i) { return instability(kind, real[i], imaginary[i], beta[i]); };
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
  // The controls are eliminated by what is orthogonal to their columns.
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(pencil.H.rightCols(m));
  const Eigen::MatrixXd rest = Eigen::MatrixXd(qr.householderQ()).rightCols(2 * n).transpose();
  const Eigen::MatrixXd U =
      stableSubspace(problem.kind, rest * pencil.H.leftCols(2 * n), rest * pencil.J.leftCols(2 * n), border);
  if (U.size() == 0) return {};
  const Eigen::PartialPivLU<Eigen::MatrixXd> upper(U.topRows(n).transpose());
  if (!(upper.rcond() > 1e-300)) return {};
  const Eigen::MatrixXd X = upper.solve(U.bottomRows(n).transpose());
  const Eigen::MatrixXd scaled = pencil.scale.asDiagonal() * X * pencil.scale.asDiagonal();
  if (!scaled.allFinite()) return {};
  return Eigen::MatrixXd(0.5 * (scaled + scaled.transpose()));
}

// What the equation lacks at X, and the gain there, in extended precision; X may be a sum of two doubles.
struct Residual {
  Eigen::MatrixXd value, K;
  double size;  // of the value, relative to the largest term
};
Residual residualAt(const Problem& problem, const Extended& X) {
  const Extended A = problem.A.cast<long double>(), B = problem.B.cast<long double>(),
                 Q = problem.Q.cast<long double>();
  const Extended XB = X * B;
  const bool isContinuous = problem.kind == Kind::kContinuous;
  const Extended weight =
      problem.R.cast<long double>() +
      (isContinuous ? Extended::Zero(B.cols(), B.cols()).eval() : Extended(B.transpose() * XB));
  const Extended K = Eigen::PartialPivLU<Extended>(weight).solve(isContinuous ? Extended(XB.transpose())
                                                                              : Extended(XB.transpose() * A));
  const Extended linear =
      isContinuous ? Extended(A.transpose() * X + X * A) : Extended(A.transpose() * X * A - X);
  const Extended quadratic = K.transpose() * weight * K;
  const Extended value = linear - quadratic + Q;
  const double largest =
      static_cast<double>(std::max({X.norm() * (isContinuous ? A.norm() : 1), quadratic.norm(), Q.norm()}));
  return {(0.5L * (value + value.transpose())).cast<double>(), K.cast<double>(),
          static_cast<double>(value.norm()) / std::max(largest, 1e-300)};
}

// Newton's steps (Kleinman 1968): each solves a Lyapunov equation of the closed loop.
Extended refined(const Problem& problem, const Eigen::MatrixXd& start) {
  Extended X = start.cast<long double>();
  Residual here = residualAt(problem, X);
  double before = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 10; ++i) {
    const Eigen::MatrixXd closed = problem.A - problem.B * here.K;
    Eigen::MatrixXd step;
    try {
      step = problem.kind == Kind::kContinuous ? solveLyapunov(closed, here.value)
                                               : solveDiscreteLyapunov(closed, here.value);
    } catch (const Error&) {
      return X;  // the closed loop is on the boundary
    }
    if (!(step.norm() < 0.5 * before)) return X;
    const Extended next = X + step.cast<long double>();
    const Residual there = residualAt(problem, next);
    if (!(there.size <= 2 * here.size)) return X;
    X = next;
    here = there;
    before = step.norm();
    if (before <= 1e-18 * static_cast<double>(X.norm())) break;
  }
  return X;
}

// An unstable eigenvalue of A for which [A - lambda, B] (or its dual) has no full rank: Hautus' test.
std::optional<std::complex<double>> badMode(const Problem& problem, const Eigen::MatrixXd& A,
                                            const Eigen::MatrixXd& B) {
  const Eigen::Index n = A.rows();
  const Eigen::VectorXcd eigenvalues = Eigen::EigenSolver<Eigen::MatrixXd>(A, false).eigenvalues();
  const double scale = std::max(A.norm(), 1e-300);
  for (const std::complex<double> lambda : eigenvalues) {
    const double margin = instability(problem.kind, lambda.real(), lambda.imag(), 1);
    if (margin < -1e-8 * (problem.kind == Kind::kContinuous ? scale : 1)) continue;
    Eigen::MatrixXcd hautus(n, n + B.cols());
    hautus << A - lambda * Eigen::MatrixXcd::Identity(n, n),
        B.cast<std::complex<double>>() * (scale / std::max(B.norm(), 1e-300));
    const Eigen::VectorXd values = Eigen::JacobiSVD<Eigen::MatrixXcd>(hautus).singularValues();
    if (values[n - 1] <= 1e-9 * scale) return lambda;
  }
  return {};
}

std::string solvedMessage(const RiccatiResult& result, double margin) {
  return fmt::format("solved: relative residual {:.2g}, closed-loop margin {:.4g}", result.residual, margin);
}

// One that no control reaches at all, told by structure: that holds for stiff systems, too.
std::optional<std::complex<double>> hiddenMode(const Problem& problem, const Eigen::MatrixXd& A,
                                               const Eigen::MatrixXd& B) {
  const double bound = 1e-7 * (problem.kind == Kind::kContinuous ? A.norm() : 1);
  for (const HiddenMode& mode : controllability({.A = A, .B = B}).modes)
    if (instability(problem.kind, mode.eigenvalue.real(), mode.eigenvalue.imag(), 1) >= -bound)
      return mode.eigenvalue;
  return {};
}

RiccatiResult solve(const Problem& problem) {
  RiccatiResult result;
  const char* edge = problem.kind == Kind::kContinuous ? "imaginary axis" : "unit circle";
  std::optional<std::complex<double>> border;  // the least stable eigenvalue of the pencil that X would keep
  const auto fail = [&](RiccatiStatus status, std::optional<std::complex<double>> mode, std::string message) {
    result = {};
    result.status = status;
    result.mode = mode;
    result.message = std::move(message);
    return result;
  };
  // Only explains what went wrong: with entries of very different size the tests themselves may err.
  const auto explain = [&](const std::string& otherwise) {
    auto mode = hiddenMode(problem, problem.A, problem.B);
    if (mode || (mode = badMode(problem, problem.A, problem.B)))
      return fail(RiccatiStatus::kNotStabilizable, mode,
                  fmt::format("not stabilizable: the control cannot reach the mode of eigenvalue {}",
                              internal::eigenvalueText(*mode)));
    mode = hiddenMode(problem, problem.A.transpose(), problem.Q);
    if (mode || (mode = badMode(problem, problem.A.transpose(), problem.Q)))
      return fail(RiccatiStatus::kNotDetectable, mode,
                  fmt::format("not detectable: the cost does not see the mode of eigenvalue {}",
                              internal::eigenvalueText(*mode)));
    if (border && std::abs(instability(problem.kind, border->real(), border->imag(), 1)) <
                      1e-6 * std::max(1., std::abs(*border)))
      return fail(
          RiccatiStatus::kFailed, border,
          fmt::format("no stabilizing solution: the equation's pencil has the eigenvalue {} on the {}",
                      internal::eigenvalueText(*border), edge));
    return fail(RiccatiStatus::kFailed, {}, otherwise);
  };
  const auto start = bySchurForm(problem, border);
  if (!start)
    return explain("no stabilizing solution: the equation's pencil has no stable part that gives one");
  const Extended X = refined(problem, *start);
  const Residual at = residualAt(problem, X);
  result.X = X.cast<double>();
  result.X = (0.5 * (result.X + result.X.transpose())).eval();
  result.K = at.K;
  result.residual = at.size;
  const Eigen::MatrixXd closed = problem.A - problem.B * result.K;
  result.closedLoop = Eigen::EigenSolver<Eigen::MatrixXd>(closed, false).eigenvalues();
  // The least stable eigenvalue, and how far rounding may have moved it: a double one moves by the root.
  double margin = -std::numeric_limits<double>::infinity(), doubt = 0;
  for (const std::complex<double> lambda : result.closedLoop) {
    const double instable = instability(problem.kind, lambda.real(), lambda.imag(), 1);
    if (instable <= margin) continue;
    margin = instable;
    doubt = problem.kind == Kind::kContinuous ? 1e-7 * std::abs(lambda) : 1e-9;
  }
  if (!(result.residual < 1e-6) || margin > doubt)
    return explain(
        fmt::format("no stabilizing solution was found: relative residual {:.2g}, closed-loop margin {:.2g}",
                    at.size, -margin));
  // An X for a mode that nothing moves is no solution, however small its residual.
  if (margin > -1e-3 * (problem.kind == Kind::kContinuous ? closed.norm() : 1) &&
      (hiddenMode(problem, problem.A, problem.B) || hiddenMode(problem, problem.A.transpose(), problem.Q)))
    return explain("");
  if (margin > -doubt) {
    if (badMode(problem, problem.A, problem.B) || badMode(problem, problem.A.transpose(), problem.Q))
      return explain("");
    result.status = RiccatiStatus::kOnBoundary;
    result.message = fmt::format(
        "closed-loop eigenvalues lie on the {}: X is the limit of stabilizing solutions, to about half the "
        "digits",
        edge);
    return result;
  }
  result.status = RiccatiStatus::kSolved;
  result.message = solvedMessage(result, -margin);
  return result;
}

}  // namespace

RiccatiResult solveCare(const MatrixArg& A, const MatrixArg& B, const MatrixArg& Q, const MatrixArg& R) {
  const Problem problem{Kind::kContinuous, A, B, Q, R};
  requireSound(problem);
  if (auto quick = internal::careByDoubling(A, B, Q, R)) {
    quick->message = solvedMessage(*quick, -quick->closedLoop.real().maxCoeff());
    return std::move(*quick);
  }
  return solve(problem);
}

RiccatiResult solveDare(const MatrixArg& A, const MatrixArg& B, const MatrixArg& Q, const MatrixArg& R) {
  const Problem problem{Kind::kDiscrete, A, B, Q, R};
  requireSound(problem);
  return solve(problem);
}

}  // namespace rex
