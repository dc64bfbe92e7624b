#include "control/gain_search.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>
#include <vector>

#include <Eigen/Eigenvalues>
#include <fmt/format.h>

#include "base/error.h"
#include "base/require.h"
#include "control/require_internal.h"
#include "control/stability.h"

namespace rex {
namespace {

double rateOf(const LinearSystem& system, const Eigen::MatrixXd& K) {
  const Eigen::MatrixXd closed = system.A - system.B * K * system.C;
  const Eigen::VectorXcd values = Eigen::EigenSolver<Eigen::MatrixXd>(closed, false).eigenvalues();
  return system.step ? values.cwiseAbs().maxCoeff() : values.real().maxCoeff();
}

struct Vertex {
  Eigen::VectorXd at;
  double value;
};
using Cost = std::function<double(const Eigen::VectorXd&)>;

bool isLower(const Vertex& a, const Vertex& b) { return a.value < b.value; }

// Moves the worst corner of the simplex, or shrinks it towards the best.
void moveSimplex(std::vector<Vertex>& simplex, const Cost& cost) {
  const std::size_t n = simplex.size() - 1;
  Eigen::VectorXd centre = Eigen::VectorXd::Zero(simplex[0].at.size());
  for (std::size_t i = 0; i < n; ++i) centre += simplex[i].at / static_cast<double>(n);
  const auto tried = [&](double factor) {
    const Eigen::VectorXd at = centre + factor * (simplex[n].at - centre);
    return Vertex{at, cost(at)};
  };
  const Vertex mirrored = tried(-1);
  if (mirrored.value < simplex[0].value) {
    Vertex farther = tried(-2);
    simplex[n] = isLower(farther, mirrored) ? std::move(farther) : mirrored;
  } else if (mirrored.value < simplex[n - 1].value) {
    simplex[n] = mirrored;
  } else {
    Vertex nearer = tried(mirrored.value < simplex[n].value ? -0.5 : 0.5);
    if (nearer.value < std::min(mirrored.value, simplex[n].value)) {
      simplex[n] = std::move(nearer);
    } else {
      for (std::size_t i = 1; i <= n; ++i) {
        simplex[i].at = 0.5 * (simplex[0].at + simplex[i].at);
        simplex[i].value = cost(simplex[i].at);
      }
    }
  }
  std::stable_sort(simplex.begin(), simplex.end(), isLower);
}

std::vector<Vertex> simplexAround(const Eigen::VectorXd& start, double size, const Cost& cost) {
  std::vector<Vertex> simplex{{start, cost(start)}};
  for (Eigen::Index i = 0; i < start.size(); ++i) {
    Eigen::VectorXd at = start;
    at[i] += at[i] > 0 ? -size : size;
    simplex.push_back({at, cost(at)});
  }
  std::stable_sort(simplex.begin(), simplex.end(), isLower);
  return simplex;
}

void requireSound(const LinearSystem& system, const Eigen::MatrixXd& start,
                  const GainSearchOptions& options) {
  if (system.B.cols() == 0) throw Error({.what = "linear system", .found = "no control"});
  if (!system.D.isZero(0))
    throw Error(
        {.what = "matrix D", .found = "entries that are not zero", .wanted = "measurements without u"});
  requireSize("rows of the first gains", start.rows(), system.B.cols());
  requireSize("columns of the first gains", start.cols(), system.C.rows());
  requireFinite("first gains", start.reshaped());
  requirePositive("bound of gains", options.bound);
  requirePositive("tolerance of gains", options.tolerance);
  requireCount("evaluations", options.maxEvaluations, 1);
  if (start.cwiseAbs().maxCoeff() > options.bound)
    throw Error({.what = "first gains",
                 .found = fmt::format("{:g}", start.cwiseAbs().maxCoeff()),
                 .wanted = fmt::format("at most the bound, {:g}", options.bound)});
}

}  // namespace

GainSearchResult fastestGains(const LinearSystem& given, const Eigen::MatrixXd& start,
                              const GainSearchOptions& options) {
  const LinearSystem system = completed(given);
  requireSound(system, start, options);
  GainSearchResult result;
  // Gains out of bounds are replaced by the nearest ones within.
  const auto gainsOf = [&](const Eigen::VectorXd& k) -> Eigen::MatrixXd {
    return k.cwiseMax(-options.bound).cwiseMin(options.bound).reshaped(start.rows(), start.cols());
  };
  const Cost cost = [&](const Eigen::VectorXd& k) {
    ++result.evaluations;
    return rateOf(system, gainsOf(k));
  };
  Vertex best{start.reshaped(), 0};
  best.value = cost(best.at);
  int idle = 0;  // restarts without progress, each with a different size
  for (double size = 0.1 * options.bound;
       idle < 4 && result.evaluations<options.maxEvaluations; size = idle> 0 ? size / 10 : size) {
    std::vector<Vertex> simplex = simplexAround(best.at, size, cost);
    while ((simplex.back().at - simplex[0].at).norm() > 1e-12 * (options.bound + simplex[0].at.norm()) &&
           result.evaluations < options.maxEvaluations)
      moveSimplex(simplex, cost);
    const double gained = best.value - simplex[0].value;
    idle = gained > options.tolerance * std::max(std::abs(best.value), 1e-3) ? 0 : idle + 1;
    if (gained > 0) best = {gainsOf(simplex[0].at).reshaped(), simplex[0].value};
  }
  result.isConverged = idle == 4;
  result.K = gainsOf(best.at);
  result.rate = best.value;
  const Eigen::MatrixXd closed = system.A - system.B * result.K * system.C;
  const StabilityResult stability = system.step ? discreteStability(closed) : continuousStability(closed);
  result.isStable = stability.stability == Stability::kAsymptotic;
  result.message =
      fmt::format("{} after {} evaluations: the slowest closed-loop eigenvalue has the {} {:.6g}{}",
                  result.isConverged ? "converged" : "evaluation limit reached", result.evaluations,
                  system.step ? "modulus" : "real part", result.rate, result.isStable ? "" : ", not stable");
  return result;
}

}  // namespace rex
