#include "optim/annealing.h"

#include <cmath>

#include "base/require.h"
#include "optim/search_checks_internal.h"

namespace rex {

AnnealingResult minimizeByAnnealing(const Objective& f, const VectorArg& start, Rng& rng,
                                    const AnnealingOptions& options) {
  constexpr const char* kName = "annealing";
  internal::requireSearch(kName, start, options.deviation, options.target, options.maxEvaluations);
  requirePositive("annealing: first temperature", options.firstTemperature);
  internal::requireSearchOption(
      options.lastTemperature > 0 && options.lastTemperature <= options.firstTemperature, kName,
      "last temperature", options.lastTemperature, "a positive number, at most the first");

  AnnealingResult result;
  result.x = result.last = start;
  Eigen::VectorXd x(start.size());
  const auto evaluate = [&](const Eigen::VectorXd& point) {
    const double found = f(point);
    result.add(point, found);
    return std::isfinite(found) ? found : std::numeric_limits<double>::infinity();
  };
  double value = evaluate(result.last);
  const auto steps = static_cast<double>(options.maxEvaluations);
  while (result.value > options.target && result.evaluations < options.maxEvaluations) {
    const double cooled = static_cast<double>(result.evaluations) / steps;
    const double temperature =
        options.firstTemperature * std::pow(options.lastTemperature / options.firstTemperature, cooled);
    for (Eigen::Index i = 0; i < x.size(); ++i) x[i] = result.last[i] + options.deviation * rng.normal();
    const double next = evaluate(x);
    ++result.iterations;
    const bool isLower = next <= value;  // also if there is no value yet
    if (!isLower && !(rng.uniform() < std::exp((value - next) / temperature))) continue;
    result.last = x;
    value = next;
    ++result.accepted;
  }
  result.end(result.value <= options.target ? SearchStatus::kTargetReached : SearchStatus::kBudgetSpent);
  return result;
}

}  // namespace rex
