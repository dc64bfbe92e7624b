#include "estimation/histogram_filter.h"

#include <cmath>

#include <fmt/format.h>

#include "base/error.h"
#include "base/require.h"

namespace rex {
namespace {

constexpr double kSumTolerance = 1e-9;

void requireBelief(const VectorArg& belief) {
  requireNotNegative("probabilities of cells", belief);
  if (std::abs(belief.sum() - 1) <= kSumTolerance) return;
  throw Error({.what = "belief",
               .found = fmt::format("probabilities that sum to {:.12g}", belief.sum()),
               .wanted = "a sum of 1"});
}

void requireTransition(const CellTransition& transition, Eigen::Index cells) {
  requireSize("columns of the transition", transition.cols(), cells);
  requireSize("rows of the transition", transition.rows(), cells);
  for (Eigen::Index j = 0; j < transition.outerSize(); ++j) {
    double sum = 0;
    bool isSound = true;
    for (CellTransition::InnerIterator entry(transition, j); entry; ++entry)
      if (!std::isfinite(entry.value()))
        throw Error(
            {.what = fmt::format("transition from cell {}", j), .found = "a probability that is not finite"});
    for (CellTransition::InnerIterator entry(transition, j); entry; ++entry) {
      isSound = isSound && entry.value() >= 0;
      sum += entry.value();
    }
    if (isSound && std::abs(sum - 1) <= kSumTolerance) continue;
    throw Error(
        {.what = fmt::format("transition from cell {}", j),
         .found = isSound ? fmt::format("probabilities that sum to {:.12g}", sum) : "a negative probability",
         .wanted = "probabilities that sum to 1"});
  }
}

}  // namespace

Eigen::VectorXd predictCells(const VectorArg& belief, const CellTransition& transition) {
  requireBelief(belief);
  requireTransition(transition, belief.size());
  const Eigen::VectorXd next = transition * belief;
  return next / next.sum();  // tolerated errors must not add up
}

CellUpdate updateCells(const VectorArg& predicted, const VectorArg& likelihood) {
  requireBelief(predicted);
  requireSize("likelihoods", likelihood.size(), predicted.size());
  requireNotNegative("likelihoods of cells", likelihood);
  CellUpdate update;
  // Relative to the likeliest cell that is possible, so that small numbers do not vanish.
  const double largest = (predicted.array() > 0).select(likelihood.array(), 0.).maxCoeff();
  update.lost = !(largest > 0);
  update.belief = predicted;
  if (update.lost) return update;
  update.belief = predicted.cwiseProduct(likelihood / largest);
  const double sum = update.belief.sum();
  update.evidence = sum * largest;
  update.belief /= sum;
  return update;
}

std::vector<Eigen::VectorXd> smoothedCells(const VectorArg& prior,
                                           std::span<const CellTransition> transitions,
                                           std::span<const Eigen::VectorXd> likelihoods) {
  if (likelihoods.empty()) return {};
  requireSize("transitions between the observations", static_cast<long>(transitions.size()),
              static_cast<long>(likelihoods.size()) - 1);
  std::vector<Eigen::VectorXd> beliefs, predictions;
  for (std::size_t t = 0; t < likelihoods.size(); ++t) {
    predictions.push_back(t == 0 ? Eigen::VectorXd(prior) : predictCells(beliefs.back(), transitions[t - 1]));
    CellUpdate update = updateCells(predictions.back(), likelihoods[t]);
    if (update.lost)
      throw Error({.what = fmt::format("observation at time {}", t), .found = "no cell that explains it"});
    beliefs.push_back(std::move(update.belief));
  }
  // The backward filter as a correction of the forward one, posterior over prediction, which neither vanishes
  // nor overflows over time.
  for (std::size_t t = transitions.size(); t-- > 0;) {
    const Eigen::VectorXd& predicted = predictions[t + 1];
    const Eigen::VectorXd ratio =
        (predicted.array() > 0).select(beliefs[t + 1].array() / predicted.array(), 0.);
    beliefs[t] = beliefs[t].cwiseProduct(transitions[t].transpose() * ratio);
    beliefs[t] /= beliefs[t].sum();
  }
  return beliefs;
}

}  // namespace rex
