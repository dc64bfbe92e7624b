#include "control/stability.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/SVD>
#include <fmt/format.h>

#include "base/error.h"
#include "control/require_internal.h"
#include "control/stability_internal.h"

namespace rex {
namespace {

using Complex = std::complex<double>;

struct Mode {
  Complex value;
  double doubt;  // how far rounding may have moved it
  bool isOnEdge;
};

// An eigenvalue moves by the error of A times the condition of its eigenvectors, 1 / |y^* x| of unit vectors.
// This alone overestimates the doubt for defective eigenvalues next to fast modes, so the distance of A
// decides, too.
std::vector<Mode> modesOf(const Eigen::MatrixXd& A, bool isDiscrete) {
  const Eigen::EigenSolver<Eigen::MatrixXd> solver(A);
  const Eigen::MatrixXcd V = solver.eigenvectors();
  // V^-1 by columns: for a matrix at once, the complex solver would take seconds to compile.
  const Eigen::FullPivLU<Eigen::MatrixXcd> lu(V);
  Eigen::MatrixXcd left(V.cols(), V.rows());
  for (Eigen::Index i = 0; i < V.rows(); ++i)
    left.col(i) = lu.solve(Eigen::VectorXcd(Eigen::VectorXcd::Unit(V.rows(), i)));
  const double norm = A.stableNorm(), rounding = internal::roundingOf(A.rows(), norm);
  // If eigenvectors are parallel to the last digit: an n-th root at worst.
  const double most = norm * std::pow(internal::roundingOf(A.rows(), 1), 1 / static_cast<double>(A.rows()));
  std::vector<Mode> modes;
  for (Eigen::Index i = 0; i < A.rows(); ++i) {
    const Complex value = solver.eigenvalues()[i];
    const double condition = V.col(i).norm() * left.row(i).norm();
    const double doubt = std::isfinite(condition) ? std::min(rounding * std::max(condition, 1.), most) : most;
    modes.push_back({value, doubt,
                     std::abs(internal::instability(value, isDiscrete)) <= doubt &&
                         internal::distanceToEdge(A, value, isDiscrete) <= rounding});
  }
  return modes;
}

// Eigenvectors of A for the eigenvalue.
int geometricMultiplicity(const Eigen::MatrixXd& A, Complex value) {
  const Eigen::Index n = A.rows();
  const Eigen::MatrixXcd shifted = A.cast<Complex>() - value * Eigen::MatrixXcd::Identity(n, n);
  const Eigen::VectorXd sizes = internal::singularValues(shifted);
  const double bound = 10 * internal::roundingOf(n, A.stableNorm());
  return std::max(1, static_cast<int>((sizes.array() <= bound).count()));
}

StabilityResult decided(const MatrixArg& given, bool isDiscrete) {
  requireSize("columns of A", given.cols(), given.rows());
  if (given.rows() == 0) throw Error({.what = "matrix A", .found = "no rows"});
  internal::requireFiniteMatrix("A", given);
  const Eigen::MatrixXd A = given;
  const char* edge = isDiscrete ? "unit circle" : "imaginary axis";
  const auto excess = [&](const Mode& mode) { return internal::instability(mode.value, isDiscrete); };
  std::vector<Mode> modes = modesOf(A, isDiscrete);
  StabilityResult result;
  result.eigenvalues.resize(A.rows());
  for (std::size_t i = 0; i < modes.size(); ++i)
    result.eigenvalues[static_cast<Eigen::Index>(i)] = modes[i].value;
  std::stable_sort(modes.begin(), modes.end(),
                   [&](const Mode& a, const Mode& b) { return excess(a) > excess(b); });
  result.eigenvalue = modes[0].value;
  result.rate = excess(modes[0]) + (isDiscrete ? 1 : 0);
  const auto growing = std::find_if(modes.begin(), modes.end(),
                                    [&](const Mode& mode) { return excess(mode) > 0 && !mode.isOnEdge; });
  if (growing != modes.end()) {
    result.eigenvalue = growing->value;
    result.message =
        fmt::format("unstable: the mode of eigenvalue {} grows", internal::eigenvalueText(growing->value));
    return result;
  }
  std::erase_if(modes, [&](const Mode& mode) { return !mode.isOnEdge; });
  if (modes.empty()) {
    result.stability = Stability::kAsymptotic;
    result.message = fmt::format("asymptotically stable: the slowest mode has the eigenvalue {}",
                                 internal::eigenvalueText(result.eigenvalue));
    return result;
  }
  result.stability = Stability::kMarginal;
  for (const Mode& mode : modes) {
    // The members of a cluster scatter around their mean, which rounding hardly moves.
    Complex sum = 0;
    int count = 0;
    for (const Mode& other : modes)
      if (std::abs(other.value - mode.value) <= 2 * (other.doubt + mode.doubt)) sum += other.value, ++count;
    const Complex mean = sum / static_cast<double>(count);
    const int geometric = std::min(count, geometricMultiplicity(A, mean));
    result.eigenvalue = mean, result.algebraic = count, result.geometric = geometric;
    if (geometric == count) continue;
    result.stability = Stability::kUnstable;
    result.message = fmt::format(
        "unstable: the eigenvalue {} on the {} counts {} times but has {} eigenvector{}: its mode grows as a "
        "power of time",
        internal::eigenvalueText(mean), edge, count, geometric, geometric == 1 ? "" : "s");
    return result;
  }
  result.message =
      fmt::format("marginally stable: the mode of eigenvalue {} on the {} neither grows nor decays",
                  internal::eigenvalueText(result.eigenvalue), edge);
  return result;
}

}  // namespace

namespace internal {

double instability(Complex eigenvalue, bool isDiscrete) {
  return isDiscrete ? std::abs(eigenvalue) - 1 : eigenvalue.real();
}

double distanceToEdge(const Eigen::MatrixXd& A, Complex near, bool isDiscrete) {
  const Complex edge = !isDiscrete ? Complex(0, near.imag()) : near == 0. ? 1. : near / std::abs(near);
  const Eigen::Index n = A.rows();
  const Eigen::MatrixXcd shifted = A.cast<Complex>() - edge * Eigen::MatrixXcd::Identity(n, n);
  return singularValues(shifted)[n - 1];
}

Eigen::MatrixXd realForm(const Eigen::MatrixXcd& M) {
  Eigen::MatrixXd real(2 * M.rows(), 2 * M.cols());
  real << M.real(), -M.imag(), M.imag(), M.real();
  return real;
}

Eigen::VectorXd singularValues(const Eigen::MatrixXcd& M) {
  const Eigen::VectorXd twice = Eigen::JacobiSVD<Eigen::MatrixXd>(realForm(M)).singularValues();
  Eigen::VectorXd values(std::min(M.rows(), M.cols()));
  for (Eigen::Index i = 0; i < values.size(); ++i) values[i] = twice[2 * i];
  return values;
}

double roundingOf(Eigen::Index n, double norm) {
  return 10 * static_cast<double>(n) * std::numeric_limits<double>::epsilon() * norm;
}

}  // namespace internal

StabilityResult continuousStability(const MatrixArg& A) { return decided(A, false); }
StabilityResult discreteStability(const MatrixArg& A) { return decided(A, true); }

}  // namespace rex
