#include "control/lyapunov_check.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <vector>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <fmt/format.h>

#include "base/derivative_check.h"
#include "base/error.h"
#include "base/require.h"
#include "control/require_internal.h"
#include "control/riccati.h"

// Both equations are solved column by column in the Schur basis A = U T U^*, where they are triangular
// (Bartels and Stewart 1972).
namespace rex {
namespace {

using Complex = std::complex<double>;

constexpr double kRounding = 1e-15;  // of an eigenvalue, per row

void requireInput(const MatrixArg& A, const MatrixArg& Q) {
  if (A.rows() == 0) throw Error({.what = "matrix A", .found = "no rows"});
  requireSize("columns of A", A.cols(), A.rows());
  internal::requireFiniteMatrix("A", A);
  internal::requireSymmetric("Q", Q, A.rows());
}

// Solves (s T^* + t) y = b with a lower triangular T^*; throws if an entry of the diagonal vanishes.
Eigen::VectorXcd solveShifted(const Eigen::MatrixXcd& T, Complex s, Complex t, Eigen::VectorXcd b,
                              const char* condition) {
  for (Eigen::Index i = 0; i < b.size(); ++i) {
    const Complex pivot = s * std::conj(T(i, i)) + t;
    if (std::abs(pivot) <= kRounding * static_cast<double>(b.size()) * (std::abs(s * T(i, i)) + std::abs(t)))
      throw Error({.what = "Lyapunov equation",
                   .found = fmt::format("the eigenvalue {:.6g}{:+.6g}i of A and another with {}",
                                        T(i, i).real(), T(i, i).imag(), condition),
                   .wanted = "no such pair"});
    b[i] = (b[i] - s * T.col(i).head(i).dot(b.head(i))) / pivot;
  }
  return b;
}

// The complex Schur form of a real matrix: the blocks of the real one are made triangular.
Eigen::ComplexSchur<Eigen::MatrixXcd> schurOf(const Eigen::MatrixXd& A) {
  const Eigen::RealSchur<Eigen::MatrixXd> real(A);
  Eigen::ComplexSchur<Eigen::MatrixXcd> schur(A.rows());
  schur.computeFromHessenberg(real.matrixT().cast<Complex>(), real.matrixU().cast<Complex>(), true);
  return schur;
}

// Coefficient by coefficient: the blocked product of complex matrices would take seconds to compile.
Eigen::MatrixXcd product(const Eigen::MatrixXcd& A, const Eigen::MatrixXcd& B) { return A.lazyProduct(B); }

Eigen::MatrixXcd inBasis(const Eigen::MatrixXcd& U, const Eigen::MatrixXd& Q) {
  return product(U.adjoint(), product(Q.cast<Complex>(), U));
}

Eigen::MatrixXd backFrom(const Eigen::MatrixXcd& U, const Eigen::MatrixXcd& Y) {
  const Eigen::MatrixXd X = product(product(U, Y), U.adjoint()).real();
  return 0.5 * (X + X.transpose());
}

}  // namespace

Eigen::MatrixXd solveLyapunov(const MatrixArg& A, const MatrixArg& Q) {
  requireInput(A, Q);
  const Eigen::ComplexSchur<Eigen::MatrixXcd> schur = schurOf(A);
  const Eigen::MatrixXcd &T = schur.matrixT(), &U = schur.matrixU(), C = inBasis(U, Q);
  Eigen::MatrixXcd Y = Eigen::MatrixXcd::Zero(A.rows(), A.rows());
  for (Eigen::Index j = 0; j < A.rows(); ++j)
    Y.col(j) = solveShifted(T, 1, T(j, j), -C.col(j) - Y.leftCols(j) * T.col(j).head(j), "a sum of zero");
  return backFrom(U, Y);
}

Eigen::MatrixXd solveDiscreteLyapunov(const MatrixArg& A, const MatrixArg& Q) {
  requireInput(A, Q);
  const Eigen::ComplexSchur<Eigen::MatrixXcd> schur = schurOf(A);
  const Eigen::MatrixXcd &T = schur.matrixT(), &U = schur.matrixU(), C = inBasis(U, Q);
  Eigen::MatrixXcd Y = Eigen::MatrixXcd::Zero(A.rows(), A.rows());
  for (Eigen::Index j = 0; j < A.rows(); ++j)
    Y.col(j) = solveShifted(T, T(j, j), -1, -C.col(j) - T.adjoint() * (Y.leftCols(j) * T.col(j).head(j)),
                            "a product of one");
  return backFrom(U, Y);
}

namespace {

constexpr double kZero = 1e-9;

std::string shown(const Eigen::VectorXd& x) {
  std::string text;
  for (const double value : x) text += fmt::format("{}{:.4g}", text.empty() ? "(" : ", ", value);
  return text + ")";
}

void requireSound(const LyapunovCandidate& candidate, const LyapunovRegion& region, int samples) {
  const Eigen::Index n = region.equilibrium.size();
  if (!candidate.V) throw Error({.what = "Lyapunov candidate", .found = "no function V"});
  if (n == 0) throw Error({.what = "region", .found = "no equilibrium"});
  requireSize("low corner of the region", region.low.size(), n);
  requireSize("high corner of the region", region.high.size(), n);
  requireFinite("low corner of the region", region.low);
  requireFinite("high corner of the region", region.high);
  requireFinite("equilibrium", region.equilibrium);
  if (!((region.low.array() < region.equilibrium.array()) &&
        (region.equilibrium.array() < region.high.array()))
           .all())
    throw Error({.what = "equilibrium",
                 .found = shown(region.equilibrium),
                 .wanted = fmt::format("a point inside {} to {}", shown(region.low), shown(region.high))});
  requireCount("samples", samples, 1);
}

// Random points at all distances from the equilibrium; also those on the way to the faces, along the axes,
// and to the corners.
std::vector<Eigen::VectorXd> pointsOf(const LyapunovRegion& region, Rng& rng, int samples) {
  const Eigen::Index n = region.equilibrium.size();
  std::vector<Eigen::VectorXd> points;
  const auto addScaled = [&](const Eigen::VectorXd& x) {
    for (const double part : {1., 1e-1, 1e-3})
      points.emplace_back(region.equilibrium + part * (x - region.equilibrium));
  };
  for (Eigen::Index i = 0; i < n; ++i)
    for (const Eigen::VectorXd* side : {&region.low, &region.high}) {
      Eigen::VectorXd x = region.equilibrium;
      x[i] = (*side)[i];
      addScaled(x);
    }
  for (unsigned corner = 0; n <= 10 && corner < (1u << n); ++corner) {
    Eigen::VectorXd x = region.low;
    for (Eigen::Index i = 0; i < n; ++i)
      if ((corner >> i) & 1u) x[i] = region.high[i];
    addScaled(x);
  }
  for (int k = 0; k < samples; ++k) {
    Eigen::VectorXd x(n);
    for (Eigen::Index i = 0; i < n; ++i) x[i] = rng.uniform(region.low[i], region.high[i]);
    points.emplace_back(region.equilibrium + std::pow(10., -3. * (k % 4) / 4) * (x - region.equilibrium));
  }
  return points;
}

double rateAt(const std::function<Eigen::VectorXd(const Eigen::VectorXd&)>& f,
              const LyapunovCandidate& candidate, const Eigen::VectorXd& x, double reach) {
  const Eigen::VectorXd velocity = f(x);
  requireSize("velocity f(x)", velocity.size(), x.size());
  requireFinite(fmt::format("velocity f at {}", shown(x)), velocity);
  if (candidate.gradient) {
    const Eigen::VectorXd gradient = candidate.gradient(x);
    requireSize("gradient of V", gradient.size(), x.size());
    return gradient.dot(velocity);
  }
  // Along the motion only; the step shrinks towards the equilibrium, where V does.
  const double speed = velocity.norm();
  if (speed == 0) return 0;
  const Eigen::VectorXd direction = velocity / speed;
  const auto along = [&](const Eigen::VectorXd& s) {
    return Eigen::VectorXd::Constant(1, candidate.V(x + s[0] * direction));
  };
  return speed * numericJacobian(along, Eigen::VectorXd::Zero(1), 1e-2 * reach)(0, 0);
}

// P A + A^T P: x^T times it times x is the rate of V = x^T P x.
Eigen::MatrixXd rateOf(const Eigen::MatrixXd& A, const Eigen::MatrixXd& P) {
  const Eigen::MatrixXd PA = P * A;
  return PA + PA.transpose();
}

LyapunovResult concluded(LyapunovResult result, bool isPositive, bool falls, bool rises) {
  result.status = !isPositive ? LyapunovStatus::kNotPositive
                  : rises     ? LyapunovStatus::kRises
                  : falls     ? LyapunovStatus::kHolds
                              : LyapunovStatus::kOnlySemidefinite;
  const std::string where = fmt::format("at {}, where V = {:.4g} and changes by {:.4g} per second",
                                        shown(result.worst), result.V, result.rate);
  result.message =
      !isPositive ? "V is not positive " + where
      : rises     ? "V rises " + where
      : falls     ? fmt::format("no counterexample in {} points; V falls least {}", result.samples, where)
                  : fmt::format("V never rises in {} points, but does not fall {}", result.samples, where);
  return result;
}

}  // namespace

LyapunovResult checkLyapunov(const std::function<Eigen::VectorXd(const Eigen::VectorXd&)>& f,
                             const LyapunovCandidate& candidate, const LyapunovRegion& region, Rng& rng,
                             int samples) {
  if (!f) throw Error({.what = "motion", .found = "no function f"});
  requireSound(candidate, region, samples);
  const double size = (region.high - region.low).norm();
  const Eigen::VectorXd atRest = f(region.equilibrium);
  requireSize("velocity f(x)", atRest.size(), region.equilibrium.size());
  if (!(atRest.norm() <= kZero * size) || !(std::abs(candidate.V(region.equilibrium)) <= kZero * size * size))
    throw Error({.what = "equilibrium",
                 .found = "a velocity or a V that is not zero",
                 .wanted = "f(x) = 0 and V(x) = 0 there"});
  LyapunovResult result;
  double leastV = std::numeric_limits<double>::infinity(), greatestRate = -leastV;
  for (const Eigen::VectorXd& x : pointsOf(region, rng, samples)) {
    const double reach = (x - region.equilibrium).norm(), squared = reach * reach;
    if (squared == 0) continue;
    ++result.samples;
    const double V = candidate.V(x), rate = rateAt(f, candidate, x, reach);
    requireFinite(fmt::format("V or its rate at {}", shown(x)), V + rate);
    const bool isNewWorst =
        leastV > kZero ? V / squared <= kZero || rate / squared > greatestRate : V / squared < leastV;
    leastV = std::min(leastV, V / squared);
    greatestRate = std::max(greatestRate, rate / squared);
    if (isNewWorst) result.worst = x, result.V = V, result.rate = rate;
  }
  return concluded(std::move(result), leastV > kZero, greatestRate<-kZero, greatestRate> kZero);
}

LyapunovCertificate certifyQuadratic(const MatrixArg& A, const MatrixArg& P) {
  const Eigen::Index n = A.rows();
  if (n == 0) throw Error({.what = "matrix A", .found = "no rows"});
  requireSize("columns of A", A.cols(), n);
  internal::requireFiniteMatrix("A", A);
  internal::requireSymmetric("P", P, n);
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> ofP(P);
  LyapunovCertificate result{.leastOfP = ofP.eigenvalues()[0], .worst = ofP.eigenvectors().col(0)};
  if (!(result.leastOfP > 1e-13 * ofP.eigenvalues()[n - 1])) {
    result.status = LyapunovStatus::kNotPositive;
    result.message =
        fmt::format("P has the eigenvalue {:.4g} in the direction {}", result.leastOfP, shown(result.worst));
    return result;
  }
  // With P = L L^T, the rate relative to V has the matrix L^-1 (P A + A^T P) L^-T in terms of L^T x.
  const Eigen::LLT<Eigen::MatrixXd> cholesky{Eigen::MatrixXd(P)};
  Eigen::MatrixXd relative = rateOf(A, P);
  cholesky.matrixL().solveInPlace(relative);
  cholesky.matrixU().solveInPlace<Eigen::OnTheRight>(relative);
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> ofRate(relative);
  result.rate = ofRate.eigenvalues()[n - 1];
  Eigen::MatrixXd directions = ofRate.eigenvectors();
  cholesky.matrixU().solveInPlace(directions);
  result.worst = directions.col(n - 1);
  result.worst.normalize();
  const double rounding = 1e-12 * ofRate.eigenvalues().cwiseAbs().maxCoeff();
  result.status = result.rate > rounding    ? LyapunovStatus::kRises
                  : result.rate < -rounding ? LyapunovStatus::kHolds
                                            : LyapunovStatus::kOnlySemidefinite;
  result.message = fmt::format("V {} in the direction {}: V' = {:.4g} V",
                               result.status == LyapunovStatus::kRises   ? "rises"
                               : result.status == LyapunovStatus::kHolds ? "falls everywhere, least"
                                                                         : "never rises, but does not fall",
                               shown(result.worst), result.rate);
  return result;
}

double certifiedLevel(const MatrixArg& A, const MatrixArg& P, double curvature) {
  requirePositive("curvature", curvature);
  if (certifyQuadratic(A, P).status != LyapunovStatus::kHolds) return 0;
  // V' <= -fall |x|^2 + 2 |P| curvature |x|^3, so V falls for |x| below a radius; the level is the largest
  // ellipsoid in that ball.
  const auto eigenvaluesOf = [](const Eigen::MatrixXd& M) -> Eigen::VectorXd {
    return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(M, Eigen::EigenvaluesOnly).eigenvalues();
  };
  const Eigen::VectorXd ofP = eigenvaluesOf(P);
  const double fall = std::max(0., -eigenvaluesOf(rateOf(A, P)).maxCoeff());
  const double radius = fall / (2 * ofP.maxCoeff() * curvature);
  return ofP.minCoeff() * radius * radius;
}

}  // namespace rex
