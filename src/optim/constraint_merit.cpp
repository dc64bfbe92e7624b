#include <algorithm>
#include <cmath>
#include <limits>

#include "optim/constraint_merit_internal.h"

namespace rex::internal {

// An inequality costs mu [g + lambda / 2 mu]+^2, an equality mu (h + kappa / 2 mu)^2, each less what it costs
// at 0 without a shift (Nocedal and Wright, Numerical Optimization, 17.4, with 2 mu for their mu).
double ConstraintMerit::value(const ConstrainedValues& at) const {
  double sum = costWeight * at.cost;
  for (Eigen::Index i = 0; i < at.g.size(); ++i) {
    if (hasBarrier) {
      if (!(at.g[i] < 0)) return std::numeric_limits<double>::infinity();
      sum -= barrier * std::log(-at.g[i]);
    } else {
      const double g = at.g[i] + margin, shifted = g + lambda[i] / (2 * penalty);
      sum += shifted <= 0 ? -lambda[i] * lambda[i] / (4 * penalty)
                          : g * (penalty * g + lambda[i]);  // NaN stays NaN
    }
  }
  for (Eigen::Index i = 0; i < at.h.size(); ++i) sum += at.h[i] * (penalty * at.h[i] + kappa[i]);
  return sum;
}

void ConstraintMerit::updateMultipliers(const ConstrainedValues& at, Eigen::VectorXd& ofG,
                                        Eigen::VectorXd& ofH) const {
  for (Eigen::Index i = 0; i < at.g.size(); ++i)
    ofG[i] = hasBarrier ? -barrier / at.g[i] : std::max(0., 2 * penalty * (at.g[i] + margin) + lambda[i]);
  for (Eigen::Index i = 0; i < at.h.size(); ++i) ofH[i] = 2 * penalty * at.h[i] + kappa[i];
}

void ConstraintMerit::weigh(const ConstrainedValues& at, ConstraintWeights& weights) const {
  weights.cost = costWeight;
  weights.g.resize(at.g.size());
  weights.gg.resize(at.g.size());
  weights.h.resize(at.h.size());
  weights.hh.setConstant(at.h.size(), 2 * penalty);
  updateMultipliers(at, weights.g, weights.h);
  for (Eigen::Index i = 0; i < at.g.size(); ++i) {
    if (hasBarrier)
      weights.gg[i] = barrier / (at.g[i] * at.g[i]);
    else
      weights.gg[i] = weights.g[i] > 0 ? 2 * penalty : 0;
  }
}

bool ConstraintMerit::weighAhead(const ConstrainedValues& at, const Eigen::VectorXd& change,
                                 ConstraintWeights& weights) const {
  bool isOther = false;
  for (Eigen::Index i = 0; i < at.g.size(); ++i) {
    const double here = 2 * penalty * (at.g[i] + margin) + lambda[i];
    const bool counts = here + 2 * penalty * change[i] > 0;
    isOther = isOther || counts != (weights.gg[i] > 0);
    weights.g[i] = counts ? here : 0;
    weights.gg[i] = counts ? 2 * penalty : 0;
  }
  return isOther;
}

}  // namespace rex::internal
