#include "control/value_grid.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "base/error.h"
#include "base/require.h"

namespace rex {
namespace {

void requireGrid(const PlanarControlProblem& problem, const ValueGridOptions& options) {
  if (!problem.rate || !problem.cost)
    throw Error({.what = "value grid", .found = "a function that is missing", .wanted = "rate and cost"});
  requireFinite("value grid: uMin", problem.uMin);
  requireFinite("value grid: uMax", problem.uMax);
  requireNotNegative("value grid: discount", problem.discount);
  for (int i = 0; i < 2; ++i) {
    if (!(options.lower[i] < options.upper[i]) || !std::isfinite(options.upper[i] - options.lower[i]))
      throw Error({.what = fmt::format("value grid: region of state {}", i),
                   .found = fmt::format("{:g} to {:g}", options.lower[i], options.upper[i]),
                   .wanted = "a lower number first"});
    rex::requireCount(fmt::format("value grid: nodes along state {}", i), options.nodes[i], 3);
  }
  if (problem.uMin > problem.uMax)
    throw Error({.what = "value grid: controls",
                 .found = fmt::format("{:g} to {:g}", problem.uMin, problem.uMax),
                 .wanted = "a lower number first"});
  rex::requireCount("value grid: controls", options.controls, 2);
  requirePositive("value grid: step", options.step, kSeconds);
  requirePositive("value grid: tolerance", options.tolerance);
  rex::requireCount("value grid: sweeps", options.maxSweeps, 1);
}

}  // namespace

ValueGrid::ValueGrid(const PlanarControlProblem& problem, const ValueGridOptions& options)
    : problem_(problem), options_(options) {
  requireGrid(problem, options);
  values_.setZero(options.nodes[0], options.nodes[1]);
  std::vector<Outcome> outcomes;
  outcomes.reserve(static_cast<std::size_t>(values_.size() * options.controls));
  for (int node = 0; node < values_.size(); ++node)
    for (int k = 0; k < options.controls; ++k) outcomes.push_back(outcomeOf(stateAt(node), controlAt(k)));
  iterate(outcomes);
}

double ValueGrid::controlAt(int k) const {
  return problem_.uMin + (problem_.uMax - problem_.uMin) * k / (options_.controls - 1);
}

Eigen::Vector2d ValueGrid::stateAt(int node) const {
  const int rows = options_.nodes[0];
  const Eigen::Array2d part(static_cast<double>(node % rows) / (rows - 1),
                            static_cast<double>(node / rows) / (options_.nodes[1] - 1));
  return options_.lower.array() + part * (options_.upper - options_.lower).array();
}

ValueGrid::Place ValueGrid::placeOf(const Eigen::Vector2d& x) const {
  int cell[2];
  double across[2];
  bool isInside = true;
  for (int i = 0; i < 2; ++i) {
    const int cells = options_.nodes[i] - 1;
    double at = (x[i] - options_.lower[i]) / (options_.upper[i] - options_.lower[i]);
    if (options_.isAngle[i] != 0)
      at -= std::floor(at);
    else if (!(at >= 0 && at <= 1))
      isInside = false, at = std::clamp(at, 0.0, 1.0);
    cell[i] = std::min(static_cast<int>(at * cells), cells - 1);
    across[i] = at * cells - cell[i];
  }
  return {cell[0] + cell[1] * options_.nodes[0], static_cast<float>(across[0]), static_cast<float>(across[1]),
          isInside};
}

double ValueGrid::valueAt(const Place& p) const {
  const double* V = values_.data() + p.node;
  const int rows = options_.nodes[0];
  return (1 - p.b) * ((1 - p.a) * V[0] + p.a * V[1]) + p.b * ((1 - p.a) * V[rows] + p.a * V[rows + 1]);
}

// One step of the classical Runge-Kutta method; the cost by Simpson's rule along it.
ValueGrid::Outcome ValueGrid::outcomeOf(const Eigen::Vector2d& x, double u) const {
  const double h = options_.step;
  const Eigen::Vector2d k1 = problem_.rate(x, u), k2 = problem_.rate(x + h / 2 * k1, u),
                        k3 = problem_.rate(x + h / 2 * k2, u), k4 = problem_.rate(x + h * k3, u);
  const Eigen::Vector2d middle = x + h / 4 * (k1 + k2), after = x + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
  const double fade = std::exp(-problem_.discount * h / 2);
  const double cost =
      h / 6 *
      (problem_.cost(x, u) + 4 * fade * problem_.cost(middle, u) + fade * fade * problem_.cost(after, u));
  if (!after.allFinite() || !std::isfinite(cost) || cost < 0)
    throw Error(
        {.what = fmt::format("value grid: state ({:g}, {:g}), control {:g}", x[0], x[1], u),
         .found = fmt::format("({:g}, {:g}) after a step, at the cost {:g}", after[0], after[1], cost),
         .wanted = "finite numbers, and no negative cost"});
  return {placeOf(after), cost};
}

// Sweeps over all controls alternate with ten over the best ones alone, which are that much cheaper.
void ValueGrid::iterate(const std::vector<Outcome>& outcomes) {
  constexpr int kCheapSweeps = 10;
  const int controls = options_.controls;
  const double fade = std::exp(-problem_.discount * options_.step);
  std::vector<int> best(static_cast<std::size_t>(values_.size()));
  const auto outcome = [&](int node, int k) -> const Outcome& {
    return outcomes[static_cast<std::size_t>(node * controls + k)];
  };
  const auto total = [&](const Outcome& o) { return o.cost + fade * valueAt(o.after); };
  // Where a state is an angle, the last node is the first one.
  const auto firstTwin = [&](int node) {
    const int rows = options_.nodes[0];
    if (options_.isAngle[0] != 0 && node % rows == rows - 1) node -= rows - 1;
    if (options_.isAngle[1] != 0 && node / rows == options_.nodes[1] - 1)
      node -= rows * (options_.nodes[1] - 1);
    return node;
  };
  while (sweeps_ < options_.maxSweeps && !isConverged_) {
    double change = 0;
    for (int node = 0; node < values_.size(); ++node) {
      double& V = values_.data()[node];
      const double before = V;
      if (const int twin = firstTwin(node); twin != node) {
        V = values_.data()[twin];
        best[static_cast<std::size_t>(node)] = best[static_cast<std::size_t>(twin)];
      } else {
        int& k = best[static_cast<std::size_t>(node)];
        double least = total(outcome(node, k));
        for (int other = 0; other < controls; ++other)
          if (const double cost = total(outcome(node, other)); cost < least) least = cost, k = other;
        V = least;
      }
      change = std::max(change, std::abs(V - before));
    }
    ++sweeps_;
    isConverged_ = change <= options_.tolerance * values_.maxCoeff();
    for (int sweep = 0; sweep < kCheapSweeps && !isConverged_; ++sweep)
      for (int node = static_cast<int>(values_.size()) - 1; node >= 0; --node)
        values_.data()[node] = total(outcome(node, best[static_cast<std::size_t>(node)]));
  }
  for (int node = 0; node < values_.size(); ++node)
    if (!outcome(node, best[static_cast<std::size_t>(node)]).after.isInside) ++leaving_;
}

double ValueGrid::value(const Eigen::Vector2d& x) const { return valueAt(placeOf(x)); }

double ValueGrid::control(const Eigen::Vector2d& x) const {
  const double fade = std::exp(-problem_.discount * options_.step);
  double best = problem_.uMin, least = HUGE_VAL;
  for (int k = 0; k < options_.controls; ++k) {
    const Outcome outcome = outcomeOf(x, controlAt(k));
    const double cost = outcome.cost + fade * valueAt(outcome.after);
    if (cost < least) least = cost, best = controlAt(k);
  }
  return best;
}

std::string ValueGrid::message() const {
  return fmt::format("{} after {} sweeps{}", isConverged_ ? "converged" : "not converged", sweeps_,
                     leaving_ > 0 ? fmt::format("; from {} nodes of {} the best motion leaves the region",
                                                leaving_, values_.size())
                                  : "");
}

}  // namespace rex
