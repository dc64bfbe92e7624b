#include "learning/behavioural_cloning.h"

#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/QR>
#include <fmt/format.h>

#include "base/error.h"
#include "base/require.h"
#include "base/rng.h"

namespace rex {
namespace {

void requireDemonstrations(const MatrixArg& features) {
  if (features.size() == 0)
    throw Error({.what = "features of the demonstrations",
                 .found = fmt::format("{} x {}", features.rows(), features.cols()),
                 .wanted = "one demonstration per row"});
  for (Eigen::Index i = 0; i < features.rows(); ++i)
    if (!features.row(i).allFinite())
      throw Error(
          {.what = fmt::format("features of demonstration {}", i), .found = "entries that are not finite"});
}

// The largest score of each row is subtracted, so that nothing overflows.
Eigen::MatrixXd softmaxOfRows(Eigen::MatrixXd scores) {
  scores.colwise() -= scores.rowwise().maxCoeff().eval();
  scores = scores.array().exp();
  scores.array().colwise() /= scores.rowwise().sum().array().eval();
  return scores;
}

// The mean of -log P plus the ridge, with what Newton's step needs.
class SoftmaxLoss {
 public:
  SoftmaxLoss(const MatrixArg& features, const std::vector<int>& actions, int count, double ridge)
      : features_(features), actions_(actions), ridge_(ridge) {
    taken_.setZero(features.rows(), count);
    for (Eigen::Index i = 0; i < features.rows(); ++i) taken_(i, actions_[static_cast<std::size_t>(i)]) = 1;
  }

  double value(const Eigen::MatrixXd& weights) const {
    const Eigen::MatrixXd scores = features_ * weights;
    const Eigen::VectorXd largest = scores.rowwise().maxCoeff();
    const Eigen::VectorXd sums = (scores.colwise() - largest).array().exp().rowwise().sum();
    const double logs = largest.sum() + sums.array().log().sum() - scores.cwiseProduct(taken_).sum();
    return logs / samples() + .5 * ridge_ * weights.squaredNorm();
  }

  Eigen::MatrixXd gradient(const Eigen::MatrixXd& weights) const {
    const Eigen::MatrixXd excess = softmaxOfRows(features_ * weights) - taken_;
    return features_.transpose() * excess / samples() + ridge_ * weights;
  }

  // Blocks for pairs of actions, each k x k, as the columns of the weights lie one after the other.
  Eigen::MatrixXd hessian(const Eigen::MatrixXd& weights) const {
    const Eigen::MatrixXd P = softmaxOfRows(features_ * weights);
    const Eigen::Index k = weights.rows(), count = weights.cols();
    Eigen::MatrixXd H(k * count, k * count);
    for (Eigen::Index a = 0; a < count; ++a)
      for (Eigen::Index b = 0; b < count; ++b) {
        Eigen::VectorXd curvature = -P.col(a).cwiseProduct(P.col(b));
        if (a == b) curvature += P.col(a);
        const Eigen::MatrixXd weighted = curvature.asDiagonal() * features_,
                              block = features_.transpose() * weighted;
        H.block(a * k, b * k, k, k) = block / samples();
      }
    H.diagonal().array() += ridge_;
    return H;
  }

 private:
  double samples() const { return static_cast<double>(features_.rows()); }

  Eigen::MatrixXd features_;
  const std::vector<int>& actions_;
  double ridge_;
  Eigen::MatrixXd taken_{};  // n x actions: one where it was taken
};

// Lowers the loss by moving the weights by Newton's step, halved until it does so; false if it never does.
bool newtonStep(const SoftmaxLoss& loss, const Eigen::MatrixXd& gradient, Eigen::MatrixXd& weights,
                double& value) {
  const Eigen::VectorXd rise = gradient.reshaped(), step = loss.hessian(weights).ldlt().solve(rise);
  const double slope = step.dot(rise);
  for (double length = 1; length > 1e-10; length /= 2) {
    const Eigen::MatrixXd next = weights - length * step.reshaped(weights.rows(), weights.cols());
    const double lower = loss.value(next);
    // Next to the optimum the loss no longer discriminates: there full steps are taken.
    if (!(lower <= value - 1e-4 * length * slope + 1e-14 * (1 + std::abs(value)))) continue;
    weights = next;
    value = lower;
    return true;
  }
  return false;
}

void requireActions(const std::vector<int>& actions, Eigen::Index demonstrations, int count) {
  requireSize("actions of the demonstrations", static_cast<long>(actions.size()), demonstrations);
  requireCount("actions", count, 2);
  for (std::size_t i = 0; i < actions.size(); ++i)
    if (actions[i] < 0 || actions[i] >= count)
      throw Error({.what = fmt::format("action of demonstration {}", i),
                   .found = fmt::format("{}", actions[i]),
                   .wanted = fmt::format("one of 0 to {}", count - 1)});
}

}  // namespace

LinearClone cloneLinear(const MatrixArg& features, const MatrixArg& actions, double ridge) {
  requireDemonstrations(features);
  requireSize("actions of the demonstrations", actions.rows(), features.rows());
  if (actions.cols() == 0) throw Error({.what = "actions of the demonstrations", .found = "none"});
  for (Eigen::Index i = 0; i < actions.rows(); ++i)
    if (!actions.row(i).allFinite())
      throw Error(
          {.what = fmt::format("action of demonstration {}", i), .found = "entries that are not finite"});
  requireNotNegative("ridge", ridge);
  // The ridge as demonstrations of doing nothing: squaring the features would cost half the digits.
  const Eigen::Index n = features.rows(), k = features.cols();
  Eigen::MatrixXd X = Eigen::MatrixXd::Zero(n + k, k), Y = Eigen::MatrixXd::Zero(n + k, actions.cols());
  X.topRows(n) = features;
  X.bottomRows(k).diagonal().setConstant(std::sqrt(ridge));
  Y.topRows(n) = actions;
  const Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> factors(X);
  LinearClone clone;
  clone.weights = factors.solve(Y);
  clone.rank = static_cast<int>(factors.rank());
  clone.residual = (features * clone.weights - actions).norm() / std::sqrt(static_cast<double>(n));
  return clone;
}

Eigen::VectorXd SoftmaxPolicy::probabilities(const VectorArg& phi) const {
  requireSize("features", phi.size(), weights.rows());
  return softmaxOfRows(phi.transpose() * weights).transpose();
}

SoftmaxClone cloneSoftmax(const MatrixArg& features, const std::vector<int>& actions, int count, double ridge,
                          int maxIterations) {
  requireDemonstrations(features);
  requireActions(actions, features.rows(), count);
  requirePositive("ridge", ridge);
  const SoftmaxLoss loss(features, actions, count, ridge);
  SoftmaxClone clone;
  Eigen::MatrixXd& weights = clone.policy.weights;
  weights.setZero(features.cols(), count);
  Eigen::MatrixXd gradient = loss.gradient(weights);
  const double tolerance = 1e-10 * features.cwiseAbs().maxCoeff();  // gradients have the unit of features
  clone.loss = loss.value(weights);
  while (clone.iterations < maxIterations && gradient.cwiseAbs().maxCoeff() > tolerance) {
    ++clone.iterations;
    if (!newtonStep(loss, gradient, weights, clone.loss)) break;
    gradient = loss.gradient(weights);
  }
  clone.residual = gradient.cwiseAbs().maxCoeff();
  const bool isConverged = clone.residual <= tolerance;
  clone.status = isConverged ? CloneStatus::kConverged : CloneStatus::kNotConverged;
  clone.message = fmt::format("{} after {} iterations: gradient {:.3g}",
                              isConverged ? "converged" : "not converged", clone.iterations, clone.residual);
  return clone;
}

std::vector<LinearClone> aggregatedClones(const ImitationTask& task, const AggregationOptions& options,
                                          Rng& rng) {
  requireCount("imitation: rounds", options.rounds, 1);
  requireCount("imitation: episodes of a round", options.episodes, 1);
  if (!(options.expertShare >= 0 && options.expertShare <= 1))
    throw Error({.what = "imitation: share of the expert",
                 .found = fmt::format("{:g}", options.expertShare),
                 .wanted = "a number from 0 to 1"});
  std::vector<LinearClone> clones;
  Eigen::MatrixXd features, actions;
  for (int round = 0; round < options.rounds; ++round) {
    const double share = std::pow(options.expertShare, round);
    const ActionOf act = [&](const VectorArg& phi) -> Eigen::VectorXd {
      if (clones.empty() || rng.uniform() < share) return task.expert(phi);
      return clones.back().weights.transpose() * phi;
    };
    for (int k = 0; k < options.episodes; ++k) {
      const Eigen::MatrixXd visited = task.episode(act, rng);
      if (visited.rows() == 0)
        throw Error({.what = "imitation: episode", .found = "no state", .wanted = "one or more"});
      if (features.size() > 0) requireSize("imitation: features", visited.cols(), features.cols());
      const Eigen::Index before = features.rows();
      features.conservativeResize(before + visited.rows(), visited.cols());
      features.bottomRows(visited.rows()) = visited;
      for (Eigen::Index i = 0; i < visited.rows(); ++i) {
        const Eigen::VectorXd action = task.expert(visited.row(i).transpose());
        actions.conservativeResize(features.rows(), action.size());
        actions.row(before + i) = action.transpose();
      }
    }
    clones.push_back(cloneLinear(features, actions, options.ridge));
  }
  return clones;
}

}  // namespace rex
