#include "estimation/smoother.h"

#include <algorithm>

#include <Eigen/Cholesky>
#include <Eigen/QR>

#include "base/error.h"
#include "estimation/covariance.h"
#include "estimation/innovation_internal.h"
#include "estimation/kalman_filter.h"

namespace rex {
namespace {

// B A^-1 of a semidefinite A, by the pseudoinverse if it is singular: what is certain stays so.
Eigen::MatrixXd dividedBy(const Eigen::MatrixXd& B, const Eigen::MatrixXd& A) {
  const Eigen::LLT<Eigen::MatrixXd> factor(A);
  if (factor.info() == Eigen::Success) return factor.solve(B.transpose()).transpose();
  return A.completeOrthogonalDecomposition().solve(B.transpose()).transpose();
}

}  // namespace

std::vector<Gaussian> smoothed(std::span<const Gaussian> filtered, std::span<const LinearModel> transitions) {
  std::vector<Gaussian> result(filtered.begin(), filtered.end());
  requireSize("transitions between the beliefs", static_cast<long>(transitions.size()),
              std::max(0L, static_cast<long>(filtered.size()) - 1));
  if (filtered.empty()) return result;
  internal::requireBelief(filtered.back());
  for (std::size_t t = transitions.size(); t-- > 0;) {
    const Gaussian predicted = kalmanPredict(filtered[t], transitions[t]);
    const Gaussian& later = result[t + 1];
    requireSize("mean of the next belief", later.mean.size(), predicted.mean.size());
    const Eigen::MatrixXd G =
        dividedBy(filtered[t].covariance * transitions[t].C.transpose(), predicted.covariance);
    result[t].mean = filtered[t].mean + G * (later.mean - predicted.mean);
    result[t].covariance =
        symmetrized(filtered[t].covariance + G * (later.covariance - predicted.covariance) * G.transpose());
  }
  return result;
}

}  // namespace rex
