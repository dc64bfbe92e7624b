#include "trajectory/motion_terms.h"

#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "base/error.h"
#include "base/require.h"

namespace rex {
namespace {

// The k-th difference of configurations, newest last: binomials with alternating signs.
TrajectoryTerm differenceTerm(const char* name, int k, Eigen::VectorXd weights) {
  const std::string what = fmt::format("weights of {}", name);
  requireNotNegative(what, weights);
  const auto function = [k, weights = std::move(weights), what](const TrajectoryWindow& window,
                                                                FunctionValue& value) {
    const Eigen::Index n = window.X.rows();
    if (weights.size() > 0) requireSize(what, weights.size(), n);
    value.y.setZero(n);
    value.J.setZero(n, (k + 1) * n);
    double factor = std::sqrt(window.tau) / std::pow(window.tau, k);
    for (int j = 0; j <= k; ++j) {
      for (Eigen::Index i = 0; i < n; ++i) {
        const double a = weights.size() > 0 ? factor * std::sqrt(weights[i]) : factor;
        value.J(i, (k - j) * n + i) = a;
        value.y[i] += a * window.X(i, k - j);
      }
      factor *= -static_cast<double>(k - j) / (j + 1);
    }
  };
  return {.name = name, .order = k, .function = function};
}

}  // namespace

TrajectoryTerm velocityTerm(Eigen::VectorXd weights) {
  return differenceTerm("velocity", 1, std::move(weights));
}

TrajectoryTerm accelerationTerm(Eigen::VectorXd weights) {
  return differenceTerm("acceleration", 2, std::move(weights));
}

TrajectoryTerm jerkTerm(Eigen::VectorXd weights) { return differenceTerm("jerk", 3, std::move(weights)); }

TrajectoryTerm postureTerm(const VectorArg& target) {
  const auto function = [target = Eigen::VectorXd(target)](const TrajectoryWindow& window,
                                                           FunctionValue& value) {
    requireSize("target of a posture", target.size(), window.X.rows());
    value.y = window.X.col(0) - target;
    value.J.setIdentity(target.size(), target.size());
  };
  return {.name = "posture", .function = function};
}

TrajectoryTerm limitsTerm(const VectorArg& lower, const VectorArg& upper) {
  requireSize("upper limits", upper.size(), lower.size());
  std::vector<std::pair<Eigen::Index, double>> limits[2];  // indices and values of lower and upper ones
  for (Eigen::Index i = 0; i < lower.size(); ++i) {
    if (!(lower[i] <= upper[i]))
      throw Error({.what = fmt::format("limits of coordinate {}", i),
                   .found = fmt::format("{:g} to {:g}", lower[i], upper[i]),
                   .wanted = "a lower one that is not above the upper one"});
    if (std::isfinite(lower[i])) limits[0].emplace_back(i, lower[i]);
    if (std::isfinite(upper[i])) limits[1].emplace_back(i, upper[i]);
  }
  const auto rows = static_cast<Eigen::Index>(limits[0].size() + limits[1].size());
  const auto function = [=, below = limits[0], above = limits[1], n = lower.size()](
                            const TrajectoryWindow& window, FunctionValue& value) {
    requireSize("limits of configurations", n, window.X.rows());
    value.y.resize(rows);
    value.J.setZero(rows, n);
    Eigen::Index row = 0;
    for (const auto& [i, limit] : below) value.y[row] = limit - window.X(i, 0), value.J(row++, i) = -1;
    for (const auto& [i, limit] : above) value.y[row] = window.X(i, 0) - limit, value.J(row++, i) = 1;
  };
  return {.name = "limits", .kind = TermKind::kInequality, .function = function};
}

TrajectoryTerm velocityLimitsTerm(const VectorArg& limit) {
  std::vector<std::pair<Eigen::Index, double>> limits;  // indices and values of the finite ones
  for (Eigen::Index i = 0; i < limit.size(); ++i) {
    requirePositiveOrInfinite("velocity limits", limit[i]);
    if (std::isfinite(limit[i])) limits.emplace_back(i, limit[i]);
  }
  const auto function = [limits, n = limit.size()](const TrajectoryWindow& window, FunctionValue& value) {
    requireSize("velocity limits", n, window.X.rows());
    const auto rows = static_cast<Eigen::Index>(limits.size());
    value.y.resize(2 * rows);
    value.J.setZero(2 * rows, 2 * n);
    Eigen::Index row = 0;
    for (const auto& [i, most] : limits) {
      const double velocity = (window.X(i, 1) - window.X(i, 0)) / window.tau;
      value.y[row] = velocity - most;
      value.y[rows + row] = -velocity - most;
      value.J(row, n + i) = value.J(rows + row, i) = 1 / window.tau;
      value.J(row, i) = value.J(rows + row, n + i) = -1 / window.tau;
      ++row;
    }
  };
  return {.name = "velocity limits", .kind = TermKind::kInequality, .order = 1, .function = function};
}

std::vector<TrajectoryTerm> restAt(const VectorArg& target, int steps) {
  TrajectoryTerm goal = as(TermKind::kEquality, at(postureTerm(target), steps - 1));
  TrajectoryTerm rest = as(TermKind::kEquality, at(velocityTerm(), steps - 1));
  goal.name = "goal";
  rest.name = "rest";
  return {goal, rest};
}

}  // namespace rex
