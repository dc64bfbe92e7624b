#include <cmath>

#include "learning/dirichlet_internal.h"

namespace rex::internal {

double drawnGamma(double shape, Rng& rng) {
  const double d = shape - 1. / 3, c = 1 / std::sqrt(9 * d);
  for (;;) {
    const double x = rng.normal(), v = std::pow(1 + c * x, 3);
    if (v > 0 && std::log(rng.uniform()) < x * x / 2 + d - d * v + d * std::log(v)) return d * v;
  }
}

// Independent Gamma draws, divided by their sum. Of a shape a it is one of a + 1 times U^(1 / a), which may
// underflow: hence logarithms.
Eigen::VectorXd drawnDirichlet(const Eigen::VectorXd& weights, Rng& rng) {
  Eigen::VectorXd logs(weights.size());
  for (Eigen::Index i = 0; i < weights.size(); ++i)
    logs[i] = std::log(drawnGamma(weights[i] + 1, rng)) + std::log(1 - rng.uniform()) / weights[i];
  const Eigen::VectorXd shares = (logs.array() - logs.maxCoeff()).exp();
  return shares / shares.sum();
}

}  // namespace rex::internal
