#include "estimation/mixture_proposal.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <utility>

#include <Eigen/Cholesky>
#include <fmt/format.h>

#include "base/error.h"
#include "base/require.h"
#include "base/rng.h"
#include "estimation/gaussian.h"
#include "estimation/resampling.h"
#include "geometry/rotation.h"

namespace rex {
namespace {

constexpr int kOutside = -1;

void requireDensity(const char* what, const StateDensity& density) {
  if (!density.draw || !density.logDensity)
    throw Error({.what = what,
                 .found = density.draw ? "no function logDensity" : "no function draw",
                 .wanted = "both"});
}

void requireGrid(const StateGrid& grid) {
  requireSize("sizes of the cells", grid.size.size(), grid.lower.size());
  requireSize("counts of the cells", grid.counts.size(), grid.lower.size());
  requireFinite("lower corner of the grid", grid.lower);
  for (Eigen::Index k = 0; k < grid.lower.size(); ++k) {
    requirePositive(fmt::format("size {} of the cells", k), grid.size[k]);
    requireCount(fmt::format("cells along {}", k), grid.counts[k], 1);
  }
}

void requireWithin(const char* what, double found, bool isRight, const char* wanted) {
  if (!isRight) throw Error({.what = what, .found = fmt::format("{:g}", found), .wanted = wanted});
}

// What mixtureProposal() draws from: p is the prediction, q the mixture.
class Mixture {
 public:
  Mixture(NonlinearModel transition, const Particles& belief, StateDensity observed,
          MixtureProposalOptions options)
      : transition_(std::move(transition)),
        observed_(std::move(observed)),
        options_(std::move(options)),
        root_(transition_.W.llt().matrixL()),
        means_(belief.states.rows(), belief.states.cols()),
        weights_(belief.weights / belief.weights.sum()) {
    for (Eigen::Index i = 0; i < means_.cols(); ++i) means_.col(i) = moved(belief.states.col(i));
    constant_ = 1 / (root_.diagonal().prod() *
                     std::pow(2 * std::numbers::pi, 0.5 * static_cast<double>(means_.rows())));
  }

  void propose(Eigen::Ref<Eigen::MatrixXd> X, Eigen::Ref<Eigen::VectorXd> logWeights, Rng& rng) const {
    requireSize("states", X.rows(), means_.rows());
    // Draws from the observation replace any particles: they get their mean weight.
    const double largest = logWeights.maxCoeff();
    const double mean = largest + std::log((logWeights.array() - largest).exp().mean());
    for (Eigen::Index i = 0; i < X.cols(); ++i) {
      const bool isObserved = rng.uniform() < options_.share;
      const Eigen::VectorXd next = isObserved ? observed_.draw(rng) : predicted(X.col(i), rng);
      requireSize("drawn state", next.size(), X.rows());
      const double p = prediction(next);
      const double q = (1 - options_.share) * p + options_.share * std::exp(observed_.logDensity(next));
      logWeights[i] = (isObserved ? mean : logWeights[i]) + std::log(p / q);
      X.col(i) = next;
    }
  }

 private:
  Eigen::VectorXd moved(const Eigen::VectorXd& x) const {
    const Eigen::VectorXd next = transition_.g(x);
    requireSize("next state", next.size(), x.size());
    return next;
  }

  Eigen::VectorXd predicted(const Eigen::VectorXd& x, Rng& rng) const {
    if (options_.kidnapping > 0 && rng.uniform() < options_.kidnapping) return options_.anywhere.draw(rng);
    return moved(x) + root_ * rng.normalVector(static_cast<int>(x.size()));
  }

  double prediction(const Eigen::VectorXd& x) const {
    constexpr double kNothing = 80;  // squared distance beyond which a normal density adds nothing
    const Eigen::Index n = x.size();
    Eigen::VectorXd error(n);
    double sum = 0;
    for (Eigen::Index i = 0; i < means_.cols(); ++i) {
      error = x - means_.col(i);
      for (const int angle : options_.angles) error[angle] = wrapAngle(error[angle]);
      double squared = 0;
      for (Eigen::Index k = 0; k < n && squared < kNothing; ++k) {  // forward substitution
        for (Eigen::Index j = 0; j < k; ++j) error[k] -= root_(k, j) * error[j];
        error[k] /= root_(k, k);
        squared += error[k] * error[k];
      }
      if (squared < kNothing) sum += weights_[i] * std::exp(-0.5 * squared);
    }
    double density = (1 - options_.kidnapping) * constant_ * sum;
    if (options_.kidnapping > 0) density += options_.kidnapping * std::exp(options_.anywhere.logDensity(x));
    return density;
  }

  NonlinearModel transition_;
  StateDensity observed_;
  MixtureProposalOptions options_;
  Eigen::MatrixXd root_;
  Eigen::MatrixXd means_;  // of the motion of each particle of the belief
  Eigen::VectorXd weights_;
  double constant_ = 0;
};

}  // namespace

Eigen::VectorXd StateGrid::center(int cell) const {
  Eigen::VectorXd x(lower.size());
  for (Eigen::Index k = 0; k < lower.size(); ++k) {
    x[k] = lower[k] + (cell % counts[k] + 0.5) * size[k];
    cell /= counts[k];
  }
  return x;
}

int StateGrid::cellOf(const Eigen::VectorXd& x) const {
  int cell = 0, stride = 1;
  for (Eigen::Index k = 0; k < lower.size(); ++k) {
    double offset = x[k] - lower[k];
    if (std::ranges::find(angles, static_cast<int>(k)) != angles.end())
      offset -= 2 * std::numbers::pi * std::floor(offset / (2 * std::numbers::pi));
    const double index = std::floor(offset / size[k]);
    if (!(index >= 0 && index < counts[k])) return kOutside;
    cell += stride * static_cast<int>(index);
    stride *= counts[k];
  }
  return cell;
}

StateDensity gridDensity(const StateGrid& grid, const VectorArg& weights) {
  requireGrid(grid);
  requireSize("weights of the cells", weights.size(), grid.cells());
  (void)effectiveSampleSize(weights);  // throws for invalid weights
  std::vector<double> sums(static_cast<std::size_t>(weights.size()));
  std::partial_sum(weights.begin(), weights.end(), sums.begin());
  const double scale = 1 / (sums.back() * grid.size.prod());
  return {.draw = [grid, sums](Rng& rng) -> Eigen::VectorXd {
            const auto cell = std::ranges::upper_bound(sums, rng.uniform() * sums.back());
            const Eigen::VectorXd inside = rng.uniformVector(static_cast<int>(grid.size.size()), -0.5, 0.5);
            return grid.center(static_cast<int>(cell - sums.begin())) + inside.cwiseProduct(grid.size);
          },
          .logDensity =
              [grid, weights = Eigen::VectorXd(weights), scale](const Eigen::VectorXd& x) {
                const int cell = grid.cellOf(x);
                return cell == kOutside ? -std::numeric_limits<double>::infinity()
                                        : std::log(weights[cell] * scale);
              }};
}

MotionSampler mixtureProposal(NonlinearModel transition, const Particles& belief, StateDensity observed,
                              MixtureProposalOptions options) {
  if (!transition.g) throw Error({.what = "transition", .found = "no function g"});
  const Eigen::Index n = belief.states.rows();
  requireCovariance("transition: covariance of the noise", transition.W, n, Definiteness::kPositive);
  requireSize("weights of the belief", belief.weights.size(), belief.states.cols());
  (void)effectiveSampleSize(belief.weights);  // throws for invalid weights
  requireDensity("density of the observation", observed);
  requireWithin("share from the observation", options.share, options.share >= 0 && options.share < 1,
                "0 to 1, less than 1");
  requireWithin("probability of kidnapping", options.kidnapping,
                options.kidnapping >= 0 && options.kidnapping <= 1, "0 to 1");
  if (options.kidnapping > 0) requireDensity("density of kidnapping", options.anywhere);
  for (const int angle : options.angles)
    if (angle < 0 || angle >= n)
      throw Error({.what = "angle of a state",
                   .found = fmt::format("entry {}", angle),
                   .wanted = fmt::format("0 to {}", n - 1)});
  return [mixture = Mixture(std::move(transition), belief, std::move(observed), std::move(options))](
             Eigen::Ref<Eigen::MatrixXd> X, Eigen::Ref<Eigen::VectorXd> logWeights, Rng& rng) {
    mixture.propose(X, logWeights, rng);
  };
}

}  // namespace rex
