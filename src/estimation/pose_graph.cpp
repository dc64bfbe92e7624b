#include "estimation/pose_graph.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>

#include <Eigen/Core>
#include <fmt/format.h>

#include "base/require.h"
#include "estimation/block_cholesky_internal.h"
#include "estimation/pose_edge_internal.h"

namespace rex {
namespace {

using internal::BlockPattern;
using internal::PlanarGraphTraits;
using internal::SpatialGraphTraits;

// The cost of a squared error, and the weight that gives its step the right slope.
struct Robust {
  double cost, weight;
};
Robust robust(double s, const PoseGraphOptions& options) {
  const double k = options.kernelSize, k2 = k * k;
  switch (options.kernel) {
    case RobustKernel::kNone:
      break;
    case RobustKernel::kHuber:
      if (s > k2) return {2 * k * std::sqrt(s) - k2, k / std::sqrt(s)};
      break;
    case RobustKernel::kCauchy:
      return {k2 * std::log1p(s / k2), 1 / (1 + s / k2)};
    case RobustKernel::kGemanMcClure:
      return {s / (1 + s / k2), 1 / ((1 + s / k2) * (1 + s / k2))};
  }
  return {s, 1};
}

void requireOptions(const PoseGraphOptions& options) {
  requirePositive("size of the robust kernel", options.kernelSize);
  requireCount("iterations", options.maxIterations, 0);
  requireNotNegative("tolerance", options.tolerance);
}

template <class Traits>
double cost(const typename Traits::Graph& graph, const PoseGraphOptions& options) {
  double sum = 0;
  for (std::size_t k = 0; k < Traits::terms(graph); ++k) {
    const auto term = Traits::termAt(graph, k, options.objective);
    sum += robust(term.e.dot(term.information * term.e), options).cost;
  }
  return sum;
}

constexpr double kRounding = 4 * std::numeric_limits<double>::epsilon();  // of a few operations

// H delta = -g, of all nodes but the first pose. The place of each edge's block is found once, since edges do
// not change.
template <class Traits>
class NormalEquations {
 public:
  static constexpr int kSize = Traits::kSize;
  using Block = Eigen::Matrix<double, kSize, kSize>;

  NormalEquations(const typename Traits::Graph& graph, const std::shared_ptr<const BlockPattern>& pattern)
      : H_(pattern) {
    for (std::size_t k = 0; k < Traits::terms(graph); ++k) {
      const auto [from, to] = Traits::ends(graph, k);
      places_.push_back(from > 0 && to > 0 ? pattern->place(from - 1, to - 1) : BlockPattern::Place());
    }
    g_.setZero(kSize * pattern->nodes());
  }

  void assemble(const typename Traits::Graph& graph, const PoseGraphOptions& options) {
    H_.setZero();
    g_.setZero();
    rounding_ = 0;
    for (std::size_t k = 0; k < Traits::terms(graph); ++k) {
      const auto [from, to] = Traits::ends(graph, k);
      const auto term = Traits::termAt(graph, k, options.objective);
      const Eigen::Matrix<double, kSize, 1> weighed = term.information * term.e;
      const double weight = robust(term.e.dot(weighed), options).weight;
      rounding_ += kRounding * kRounding * term.scale.cwiseAbs2().dot(term.information.diagonal());
      const Block WJi = weight * term.information * term.Ji, WJj = weight * term.information * term.Jj;
      if (from > 0) add(from, term.Ji.transpose() * WJi, term.Ji.transpose() * (weight * weighed));
      if (to > 0) add(to, term.Jj.transpose() * WJj, term.Jj.transpose() * (weight * weighed));
      if (from > 0 && to > 0) H_.add(places_[k], term.Ji.transpose() * WJj);
    }
  }

  // Empty if H + damping is not positive definite.
  Eigen::VectorXd solve(double damping) {
    if (!H_.factorize(damping)) return {};
    return H_.solve(-g_);
  }

  double largestDiagonal() const {
    double largest = 0;
    for (int i = 0; i < H_.pattern().nodes(); ++i)
      largest = std::max(largest, H_.diagonal(i).diagonal().maxCoeff());
    return largest;
  }
  const Eigen::VectorXd& gradient() const { return g_; }
  // The cost that rounding alone can give edges that fit exactly.
  double rounding() const { return rounding_; }

 private:
  template <class Slope>
  void add(int node, const Block& block, const Slope& slope) {
    H_.diagonal(node - 1) += block;
    g_.template segment<kSize>(kSize * (node - 1)) += slope;
  }

  internal::BlockCholesky<kSize> H_;
  Eigen::VectorXd g_;
  std::vector<BlockPattern::Place> places_;  // of each edge
  double rounding_ = 0;
};

constexpr double kLeastDamping = 1e-10, kMostDamping = 1e12;

// Levenberg and Marquardt's steps; the damping follows how well the model predicted the gain (Nielsen 1999).
template <class Traits>
void descend(typename Traits::Graph& graph, const PoseGraphOptions& options,
             const std::shared_ptr<const BlockPattern>& pattern, PoseGraphResult& result) {
  NormalEquations<Traits> equations(graph, pattern);
  equations.assemble(graph, options);
  double damping = 0, growth = 10;  // damping relative to the largest entry of the diagonal
  auto before = Traits::unknowns(graph);
  while (result.iterations < options.maxIterations) {
    ++result.iterations;
    const double shift = damping * equations.largestDiagonal();
    const Eigen::VectorXd delta = equations.solve(shift);
    const bool isStep = delta.size() > 0 && delta.allFinite();
    before = Traits::unknowns(graph);
    if (isStep) Traits::step(graph, delta);
    const double lower = isStep ? cost<Traits>(graph, options) : result.cost;
    // At the minimum, rounding may make a cost a hair larger than before.
    const double gain = result.cost - lower, hair = 1e-13 * result.cost + equations.rounding();
    const double foretold = isStep ? delta.dot(shift * delta - equations.gradient()) : 0;
    const bool isDone = isStep && gain >= -hair && foretold <= options.tolerance * lower + hair;
    if (isStep && gain >= 0)
      result.cost = lower;
    else
      Traits::set(graph, std::move(before));
    if (isDone) {
      result.status = PoseGraphStatus::kConverged;
      return;
    }
    if (!isStep || !(gain >= 0)) {
      damping = std::max(growth * damping, kLeastDamping);
      growth *= 4;
      if (damping < kMostDamping) continue;
      result.status = PoseGraphStatus::kNoProgress;
      return;
    }
    damping *= std::max(0.1, 1 - std::pow(2 * gain / foretold - 1, 3));
    if (damping < kLeastDamping) damping = 0;
    growth = 10;
    equations.assemble(graph, options);
  }
}

// The outcome in words.
std::string endOf(const PoseGraphResult& result) {
  const std::string count =
      fmt::format("{} iteration{}", result.iterations, result.iterations == 1 ? "" : "s");
  switch (result.status) {
    case PoseGraphStatus::kConverged:
      return "converged after " + count;
    case PoseGraphStatus::kNoProgress:
      return fmt::format("gave up after {}, because no step lowers the cost", count);
    case PoseGraphStatus::kBudgetSpent:
      return fmt::format("stopped after {}, the limit, before it converged", count);
  }
  return count;
}

// Keeps the chordal start if it costs less than the given poses.
template <class Traits>
void startChordal(typename Traits::Graph& graph, const PoseGraphOptions& options,
                  const std::shared_ptr<const BlockPattern>& pattern, PoseGraphResult& result) {
  auto given = Traits::unknowns(graph);
  internal::setChordalPoses(graph, pattern);
  const double chordal = cost<Traits>(graph, options);
  if (chordal < result.cost)
    result.cost = chordal;
  else
    Traits::set(graph, std::move(given));
}

template <class Traits>
PoseGraphResult optimizeGraph(typename Traits::Graph& graph, const PoseGraphOptions& options) {
  internal::requireSound(graph);
  internal::requireConnected(graph);
  requireOptions(options);
  PoseGraphResult result;
  result.cost = result.initialCost = cost<Traits>(graph, options);
  result.status = PoseGraphStatus::kConverged;
  if (Traits::nodes(graph) > 1) {
    const auto pattern = internal::patternOf<Traits>(graph, 1);
    if (options.chordalStart) startChordal<Traits>(graph, options, pattern, result);
    result.status = PoseGraphStatus::kBudgetSpent;
    descend<Traits>(graph, options, pattern, result);
  }
  result.message =
      fmt::format("{}: cost {:.10g}, {:.10g} at the start", endOf(result), result.cost, result.initialCost);
  return result;
}

}  // namespace

double poseGraphCost(const PlanarPoseGraph& graph, const PoseGraphOptions& options) {
  requireOptions(options);
  internal::requireSound(graph);
  return cost<PlanarGraphTraits>(graph, options);
}
double poseGraphCost(const SpatialPoseGraph& graph, const PoseGraphOptions& options) {
  requireOptions(options);
  internal::requireSound(graph);
  return cost<SpatialGraphTraits>(graph, options);
}

PoseGraphResult optimize(PlanarPoseGraph& graph, const PoseGraphOptions& options) {
  return optimizeGraph<PlanarGraphTraits>(graph, options);
}
PoseGraphResult optimize(SpatialPoseGraph& graph, const PoseGraphOptions& options) {
  return optimizeGraph<SpatialGraphTraits>(graph, options);
}

}  // namespace rex
