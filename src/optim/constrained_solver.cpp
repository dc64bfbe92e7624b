#include "optim/constrained_solver.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "base/error.h"
#include "base/require.h"
#include "optim/constrained_descent_internal.h"
#include "optim/search_result_internal.h"

namespace rex {
namespace {

using internal::ConstrainedDescent;
using internal::ConstraintMerit;
using internal::DescentEnd;

constexpr double kFirstTolerance = 1e-2;  // of the first rounds' gradients, which need not be exact
constexpr double kFallWanted = 0.5;       // of the violation from one round to the next
constexpr double kStationaryPart = 1e-3;  // of the violation: its gradient if it gets no smaller
constexpr int kFeasibilitySteps = 600;    // spent at most to see whether the violation can get smaller
constexpr double kRunaway = 100;          // a violation held by the penalty grows by less than this
constexpr int kRoundsWithoutFall = 6;
constexpr int kMostRounds = 200;

void requireSound(const VectorArg& start, const ConstrainedOptions& options) {
  constexpr const char* kName = "constrained solver";
  const auto require = [](bool isRight, const char* what, double number, const char* wanted) {
    internal::requireSearchOption(isRight, kName, what, number, wanted);
  };
  requireCount("constrained solver: coordinates of the start", start.size(), 1);
  requireFinite("constrained solver: start", start);
  requirePositive("constrained solver: tolerance", options.tolerance);
  requirePositive("constrained solver: stationarity", options.stationarity);
  requirePositive("constrained solver: step tolerance", options.stepTolerance);
  requirePositive("constrained solver: penalty", options.penalty);
  requirePositive("constrained solver: barrier", options.barrier);
  require(options.largestPenalty >= options.penalty, "largest penalty", options.largestPenalty,
          "no less than the penalty at the start");
  require(options.factor > 1 && std::isfinite(options.factor), "factor", options.factor,
          "a finite number above 1");
  requireNotNegative("constrained solver: damping", options.damping);
  requireCount("constrained solver: budget of iterations", options.maxIterations, 1);
}

Eigen::VectorXd startOf(const Eigen::VectorXd& multipliers, Eigen::Index size, const char* what) {
  if (multipliers.size() == 0) return Eigen::VectorXd::Zero(size);
  requireSize(what, multipliers.size(), size);
  requireFinite(what, multipliers);
  return multipliers;
}

// Which row is violated most, or nearest to it.
std::string worstName(const ConstrainedSystem& system, const ConstrainedValues& values) {
  Eigen::Index g = 0, h = 0;
  const double worstG = values.g.size() > 0 ? values.g.maxCoeff(&g) : -1;
  const double worstH = values.h.size() > 0 ? values.h.cwiseAbs().maxCoeff(&h) : -1;
  if (values.g.size() + values.h.size() == 0) return {};
  return worstH >= worstG && values.h.size() > 0 ? system.equalityName(h) : system.inequalityName(g);
}

class ConstrainedSolver {
 public:
  ConstrainedSolver(ConstrainedSystem& system, const VectorArg& start, const ConstrainedOptions& options)
      : system_(system), options_(options), descent_(system, start, options, result_) {
    const ConstrainedValues& values = descent_.values();
    lambda_ = startOf(options.inequalityMultipliers, values.g.size(), "multipliers of inequalities");
    kappa_ = startOf(options.equalityMultipliers, values.h.size(), "multipliers of equalities");
    lambda_ = lambda_.cwiseMax(0);
    const bool isShifted = options.method != ConstraintMethod::kSquaredPenalty;
    merit_ = {.penalty = options.penalty,
              .barrier = options.barrier,
              .lambda = isShifted ? lambda_ : Eigen::VectorXd::Zero(lambda_.size()),
              .kappa = isShifted ? kappa_ : Eigen::VectorXd::Zero(kappa_.size())};
  }

  ConstrainedResult run() {
    const ConstrainedValues& values = descent_.values();
    if (!std::isfinite(values.cost) || !values.g.allFinite() || !values.h.allFinite())
      return end(ConstrainedStatus::kNotFinite);
    if (!descent_
             .gradientOf(
                 plainWeights(Eigen::VectorXd::Ones(values.g.size()), Eigen::VectorXd::Ones(values.h.size())))
             .allFinite())
      return end(ConstrainedStatus::kNotFinite);
    if (options_.method == ConstraintMethod::kLogBarrier && values.g.size() > 0) {
      const ConstrainedStatus inside = moveInside();
      if (inside != ConstrainedStatus::kSolved) return end(inside);
      merit_.hasBarrier = true;
    }
    first_ = descent_.x();
    ConstrainedStatus status = loop();
    const bool mayBeInfeasible =
        status == ConstrainedStatus::kBudgetSpent || status == ConstrainedStatus::kNoProgress;
    if (mayBeInfeasible && internal::violationOf(values) > options_.tolerance && isInfeasible())
      status = ConstrainedStatus::kInfeasible;
    return end(status);
  }

 private:
  // Slides down the violation of g + margin alone, for smaller and smaller margins.
  ConstrainedStatus moveInside() {
    ConstraintMerit feasibility = merit_;
    feasibility.costWeight = 0;
    feasibility.kappa.setZero();
    feasibility.lambda.setZero();
    for (feasibility.margin = 1e-1; feasibility.margin > options_.tolerance / 10; feasibility.margin /= 10) {
      const DescentEnd how = descent_.descend(feasibility, 1e-12 * feasibility.margin, true);
      if (how == DescentEnd::kInside) return ConstrainedStatus::kSolved;
      if (how == DescentEnd::kBudgetSpent) return ConstrainedStatus::kBudgetSpent;
    }
    return ConstrainedStatus::kInfeasible;
  }

  ConstrainedStatus loop() {
    double tolerance = std::max(kFirstTolerance, options_.stationarity),
           before = internal::violationOf(descent_.values());
    int without = 0;
    for (int round = 0; round < kMostRounds; ++round) {
      const DescentEnd how = descent_.descend(merit_, tolerance);
      if (isPenaltyTooWeak(how, before)) {
        merit_.penalty = std::min(merit_.penalty * options_.factor, options_.largestPenalty);
        descent_.moveTo(first_);
        continue;
      }
      merit_.updateMultipliers(descent_.values(), lambda_, kappa_);
      if (how == DescentEnd::kBudgetSpent) return ConstrainedStatus::kBudgetSpent;
      if (how == DescentEnd::kUnbounded) return ConstrainedStatus::kUnbounded;
      const double violation = internal::violationOf(descent_.values());
      const bool isFeasible = violation <= options_.tolerance && complementarity() <= options_.tolerance;
      if (isFeasible && tolerance <= options_.stationarity)
        return how == DescentEnd::kConverged ? ConstrainedStatus::kSolved : ConstrainedStatus::kNoProgress;
      without = violation > options_.tolerance && violation > kFallWanted * before ? without + 1 : 0;
      if (without >= kRoundsWithoutFall) {
        if (isInfeasible()) return ConstrainedStatus::kInfeasible;
        without = 0;
      }
      if (violation > options_.tolerance && merit_.penalty >= options_.largestPenalty)
        return ConstrainedStatus::kNoProgress;
      prepareRound(violation, before);
      before = violation;
      tolerance = std::max(tolerance / 10, options_.stationarity);
    }
    return ConstrainedStatus::kBudgetSpent;
  }

  void prepareRound(double violation, double before) {
    if (options_.method != ConstraintMethod::kSquaredPenalty) {
      if (!merit_.hasBarrier) merit_.lambda = lambda_;
      merit_.kappa = kappa_;
    }
    // A barrier below what complementarity asks for would only spoil the numbers.
    if (merit_.hasBarrier) merit_.barrier = std::max(merit_.barrier / options_.factor, options_.tolerance);
    const bool isSlow = options_.method == ConstraintMethod::kSquaredPenalty || violation > before / 4;
    if (violation > options_.tolerance && isSlow)
      merit_.penalty = std::min(merit_.penalty * options_.factor, options_.largestPenalty);
  }

  // If a concave cost outweighs the penalty, it falls without end, outside of the constraints. `before` is
  // the violation at the start of the round.
  [[nodiscard]] bool isPenaltyTooWeak(DescentEnd how, double before) const {
    const double violation = internal::violationOf(descent_.values());
    if (merit_.penalty >= options_.largestPenalty) return false;
    return violation > kRunaway * std::max(1., before) ||
           (how == DescentEnd::kUnbounded && violation > options_.tolerance);
  }

  // Slides down the violation |g+|^2 + |h|^2 alone: infeasible if that ends, but not at zero.
  bool isInfeasible() {
    ConstraintMerit feasibility = merit_;
    feasibility.hasBarrier = false;
    feasibility.costWeight = 0;
    feasibility.penalty = 1;
    feasibility.lambda.setZero();
    feasibility.kappa.setZero();
    const int steps = std::min(kFeasibilitySteps, options_.maxIterations);
    descent_.extendBudget(steps);
    const int before = result_.iterations;
    (void)descent_.descend(feasibility,
                           kStationaryPart / 10 * std::min(1., internal::violationOf(descent_.values())));
    descent_.extendBudget(result_.iterations - before - steps);
    const ConstrainedValues& values = descent_.values();
    const double violation = internal::violationOf(values);
    const double slope = maxOf(descent_.gradientOf(plainWeights(values.g.cwiseMax(0), values.h, 0)));
    return violation > options_.tolerance && slope <= kStationaryPart * violation;
  }

  [[nodiscard]] static ConstraintWeights plainWeights(const Eigen::VectorXd& g, const Eigen::VectorXd& h,
                                                      double cost = 1) {
    return {.cost = cost,
            .g = g,
            .h = h,
            .gg = Eigen::VectorXd::Zero(g.size()),
            .hh = Eigen::VectorXd::Zero(h.size())};
  }

  [[nodiscard]] static double maxOf(const Eigen::VectorXd& v) {
    return v.size() > 0 ? v.cwiseAbs().maxCoeff() : 0;
  }

  // With a barrier, lambda_i g_i = -b, and neither of them can be zero.
  [[nodiscard]] double complementarity() const {
    double largest = 0;
    const Eigen::VectorXd& g = descent_.values().g;
    for (Eigen::Index i = 0; i < g.size(); ++i)
      largest = std::max(
          largest, merit_.hasBarrier ? std::abs(lambda_[i] * g[i]) : std::abs(std::min(lambda_[i], -g[i])));
    return largest;
  }

  ConstrainedResult end(ConstrainedStatus status) {
    const ConstrainedValues& values = descent_.values();
    result_.status = status;
    result_.x = descent_.x();
    result_.cost = values.cost;
    result_.violation = internal::violationOf(values);
    result_.mostViolated = worstName(system_, values);
    result_.complementarity = complementarity();
    result_.inequalityMultipliers = lambda_;
    result_.equalityMultipliers = kappa_;
    result_.penalty = merit_.penalty;
    if (status != ConstrainedStatus::kNotFinite) {
      result_.stationarity = maxOf(descent_.gradientOf(plainWeights(lambda_, kappa_)));
    }
    result_.message = fmt::format("{} ({}) after {} steps: cost {:.6g}", toString(status),
                                  toString(options_.method), result_.iterations, result_.cost);
    if (!result_.mostViolated.empty() && (result_.violation > 0 || status == ConstrainedStatus::kInfeasible))
      result_.message +=
          fmt::format(", most violated is {} by {:.3g}", result_.mostViolated, result_.violation);
    return std::move(result_);
  }

  ConstrainedSystem& system_;
  const ConstrainedOptions& options_;
  ConstrainedResult result_;
  ConstrainedDescent descent_;
  ConstraintMerit merit_;
  Eigen::VectorXd lambda_, kappa_, first_;
};

}  // namespace

const char* toString(ConstraintMethod method) {
  switch (method) {
    case ConstraintMethod::kSquaredPenalty:
      return "squared penalty";
    case ConstraintMethod::kLogBarrier:
      return "log barrier";
    case ConstraintMethod::kAugmentedLagrangian:
      return "augmented Lagrangian";
  }
  return "";
}

const char* toString(ConstrainedStatus status) {
  switch (status) {
    case ConstrainedStatus::kSolved:
      return "solved";
    case ConstrainedStatus::kInfeasible:
      return "infeasible";
    case ConstrainedStatus::kNoProgress:
      return "no progress";
    case ConstrainedStatus::kBudgetSpent:
      return "budget spent";
    case ConstrainedStatus::kUnbounded:
      return "unbounded";
    case ConstrainedStatus::kNotFinite:
      return "not finite at the start";
  }
  return "";
}

ConstrainedResult solveConstrained(ConstrainedSystem& system, const VectorArg& start,
                                   const ConstrainedOptions& options) {
  requireSound(start, options);
  return ConstrainedSolver(system, start, options).run();
}

ConstrainedResult solveConstrained(const ConstrainedProblem& problem, const VectorArg& start,
                                   const ConstrainedOptions& options) {
  if (!problem.residuals && !problem.cost)
    throw Error({.what = "problem with constraints",
                 .found = "neither residuals nor a cost",
                 .wanted = "at least one of them"});
  requireSound(start, options);
  internal::DenseSystem system(problem, start.size());
  return ConstrainedSolver(system, start, options).run();
}

}  // namespace rex
