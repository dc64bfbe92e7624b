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
#include "control/eigenvalue_text_internal.h"

namespace rex {
namespace {

using Complex = std::complex<double>;

struct Mode {
  Complex value;
  double doubt;  // how far rounding may have moved it
};

// An eigenvalue moves by what A is off, times the condition of its eigenvectors: 1 / |y^* x| of unit vectors.
std::vector<Mode> modesOf(const Eigen::MatrixXd& A) {
  const Eigen::EigenSolver<Eigen::MatrixXd> solver(A);
  const Eigen::MatrixXcd V = solver.eigenvectors();
  const Eigen::MatrixXcd left = Eigen::FullPivLU<Eigen::MatrixXcd>(V).inverse();
  const double rounding =
      10 * static_cast<double>(A.rows()) * std::numeric_limits<double>::epsilon() * A.norm();
  std::vector<Mode> modes;
  for (Eigen::Index i = 0; i < A.rows(); ++i) {
    const double condition = V.col(i).norm() * left.row(i).norm();
    // Where eigenvectors are parallel to the last digit: a root of order n at worst.
    const double most =
        A.norm() * std::pow(rounding / std::max(A.norm(), 1e-300), 1 / static_cast<double>(A.rows()));
    modes.push_back({solver.eigenvalues()[i],
                     std::isfinite(condition) ? std::min(rounding * std::max(condition, 1.), most) : most});
  }
  return modes;
}

// Eigenvectors of A for the eigenvalue.
int geometricMultiplicity(const Eigen::MatrixXd& A, Complex value) {
  const Eigen::Index n = A.rows();
  const Eigen::MatrixXcd shifted = A.cast<Complex>() - value * Eigen::MatrixXcd::Identity(n, n);
  const Eigen::VectorXd sizes = Eigen::JacobiSVD<Eigen::MatrixXcd>(shifted).singularValues();
  const double bound =
      100 * static_cast<double>(n) * std::numeric_limits<double>::epsilon() * std::max(A.norm(), 1e-300);
  return std::max(1, static_cast<int>((sizes.array() <= bound).count()));
}

StabilityResult decided(const MatrixArg& given, bool isDiscrete) {
  requireSize("columns of A", given.cols(), given.rows());
  if (given.rows() == 0) throw Error({.what = "matrix A", .found = "no rows"});
  if (!given.allFinite()) throw Error({.what = "matrix A", .found = "entries that are not finite"});
  const Eigen::MatrixXd A = given;
  const char* edge = isDiscrete ? "unit circle" : "imaginary axis";
  const auto excess = [&](Complex value) { return isDiscrete ? std::abs(value) - 1 : value.real(); };
  std::vector<Mode> modes = modesOf(A);
  StabilityResult result;
  result.eigenvalues.resize(A.rows());
  for (std::size_t i = 0; i < modes.size(); ++i)
    result.eigenvalues[static_cast<Eigen::Index>(i)] = modes[i].value;
  std::stable_sort(modes.begin(), modes.end(),
                   [&](const Mode& a, const Mode& b) { return excess(a.value) > excess(b.value); });
  result.eigenvalue = modes[0].value;
  result.rate = excess(modes[0].value) + (isDiscrete ? 1 : 0);
  const std::string found = internal::eigenvalueText(modes[0].value);
  if (excess(modes[0].value) > modes[0].doubt) {
    result.message = fmt::format("unstable: the mode of eigenvalue {} grows", found);
    return result;
  }
  std::erase_if(modes, [&](const Mode& mode) { return excess(mode.value) < -mode.doubt; });
  if (modes.empty()) {
    result.stability = Stability::kAsymptotic;
    result.message = fmt::format("asymptotically stable: the slowest mode has the eigenvalue {}", found);
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

StabilityResult stabilityOf(const MatrixArg& A) { return decided(A, false); }
StabilityResult discreteStabilityOf(const MatrixArg& A) { return decided(A, true); }

}  // namespace rex
