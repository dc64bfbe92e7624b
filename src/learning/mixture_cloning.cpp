#include "learning/mixture_cloning.h"

#include <cmath>
#include <numbers>
#include <utility>

#include <Eigen/Cholesky>
#include <fmt/format.h>

#include "base/error.h"
#include "base/require.h"

namespace rex {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// log N(x; mean, covariance) of each column of X.
VectorXd logNormals(const MatrixXd& X, const VectorXd& mean, const MatrixXd& covariance) {
  const Eigen::LLT<MatrixXd> factors(covariance);
  double logDeterminant = 0;
  for (Index i = 0; i < mean.size(); ++i) logDeterminant += 2 * std::log(factors.matrixLLT()(i, i));
  const MatrixXd offsets = X.colwise() - mean;
  const MatrixXd solved = factors.solve(offsets);
  VectorXd logs(X.cols());
  for (Index i = 0; i < X.cols(); ++i) logs[i] = -offsets.col(i).dot(solved.col(i)) / 2;
  return logs.array() -
         (logDeterminant + static_cast<double>(mean.size()) * std::log(2 * std::numbers::pi)) / 2;
}

double logSumExp(const Eigen::RowVectorXd& logs) {
  const double most = logs.maxCoeff();
  return most + std::log((logs.array() - most).exp().sum());
}

// A mixture of normal distributions of states and actions, both in a column.
struct JointMixture {
  VectorXd weights;
  std::vector<VectorXd> means;
  std::vector<MatrixXd> covariances;

  // log(weight N(column)): columns x experts.
  MatrixXd logTerms(const MatrixXd& Z) const {
    MatrixXd logs(Z.cols(), weights.size());
    for (Index k = 0; k < weights.size(); ++k) {
      const auto i = static_cast<std::size_t>(k);
      logs.col(k) = logNormals(Z, means[i], covariances[i]).array() + std::log(weights[k]);
    }
    return logs;
  }
};

// Centres that are far from each other, as k-means++ draws them, and the variances of all.
JointMixture drawnMixture(const MatrixXd& Z, const VectorXd& variances, Index count, Rng& rng) {
  JointMixture mixture{VectorXd::Constant(count, 1. / static_cast<double>(count)), {}, {}};
  VectorXd distances = VectorXd::Ones(Z.cols());
  for (Index k = 0; k < count; ++k) {
    double left = rng.uniform() * distances.sum();
    Index chosen = 0;
    while (chosen + 1 < Z.cols() && (left -= distances[chosen]) >= 0) ++chosen;
    mixture.means.emplace_back(Z.col(chosen));
    mixture.covariances.emplace_back(variances.asDiagonal());
    for (Index i = 0; i < Z.cols(); ++i) {
      const double distance = ((Z.col(i) - Z.col(chosen)).array().square() / variances.array()).sum();
      distances[i] = k == 0 ? distance : std::min(distances[i], distance);
    }
  }
  return mixture;
}

// The maximisation step: weighted means and covariances. `penalty` is added to the sums of squares, as by a
// prior exp(-tr(penalty covariance^-1) / 2).
void maximize(JointMixture& mixture, const MatrixXd& Z, const MatrixXd& shares, const VectorXd& penalty) {
  for (Index k = 0; k < shares.cols(); ++k) {
    const auto i = static_cast<std::size_t>(k);
    const double count = std::max(shares.col(k).sum(), 1e-300);
    mixture.weights[k] = count / static_cast<double>(Z.cols());
    mixture.means[i] = Z * shares.col(k) / count;
    const MatrixXd offsets = Z.colwise() - mixture.means[i];
    const MatrixXd weighted = offsets * shares.col(k).asDiagonal();
    MatrixXd squares = weighted * offsets.transpose();
    squares.diagonal() += penalty;
    mixture.covariances[i] = squares / count;
  }
}

MixtureExpert conditioned(double weight, const VectorXd& mean, const MatrixXd& covariance, Index d) {
  const Index m = mean.size() - d;
  const MatrixXd S_xx = covariance.topLeftCorner(d, d), S_xa = covariance.topRightCorner(d, m);
  const MatrixXd gain = S_xx.llt().solve(S_xa);
  const MatrixXd explained = gain.transpose() * S_xa;
  return {weight,
          mean.head(d),
          S_xx,
          mean.tail(m),
          gain.transpose(),
          covariance.bottomRightCorner(m, m) - (explained + explained.transpose()) / 2};
}

MixtureClone runFrom(JointMixture mixture, const MatrixXd& Z, Index d, const VectorXd& penalty,
                     const MixtureCloneOptions& options) {
  MixtureClone clone;
  for (int iteration = 0; iteration <= options.maxIterations; ++iteration) {
    MatrixXd shares = mixture.logTerms(Z);
    clone.logLikelihood = 0;
    for (Index i = 0; i < Z.cols(); ++i) {
      const double log = logSumExp(shares.row(i));
      clone.logLikelihood += log;
      shares.row(i) = (shares.row(i).array() - log).exp();
    }
    double objective = clone.logLikelihood;
    for (const MatrixXd& covariance : mixture.covariances) {
      const MatrixXd weighted = covariance.llt().solve(MatrixXd(penalty.asDiagonal()));
      objective -= weighted.trace() / 2;
    }
    const bool isFirst = clone.history.empty();
    const double rise = isFirst ? 0 : objective - clone.history.back();
    clone.history.push_back(objective);
    if (!isFirst && rise <= options.tolerance * static_cast<double>(Z.cols())) {
      clone.status = CloneStatus::kConverged;
      break;
    }
    if (iteration < options.maxIterations) maximize(mixture, Z, shares, penalty);
  }
  for (std::size_t k = 0; k < mixture.means.size(); ++k)
    clone.policy.experts.push_back(
        conditioned(mixture.weights[static_cast<Index>(k)], mixture.means[k], mixture.covariances[k], d));
  clone.message = fmt::format("{} after {} iterations: log likelihood {:.6g}",
                              clone.status == CloneStatus::kConverged ? "converged" : "not converged",
                              clone.history.size() - 1, clone.logLikelihood);
  return clone;
}

void requireFiniteRows(const char* what, const MatrixArg& rows) {
  if (rows.cols() == 0) throw Error({.what = fmt::format("{} of the demonstrations", what), .found = "none"});
  for (Index i = 0; i < rows.rows(); ++i)
    if (!rows.row(i).allFinite())
      throw Error(
          {.what = fmt::format("{} of demonstration {}", what, i), .found = "entries that are not finite"});
}

}  // namespace

VectorXd MixtureExpert::action(const VectorArg& state) const {
  requireSize("state of an expert", state.size(), meanState.size());
  return meanAction + gain * (state - meanState);
}

VectorXd MixturePolicy::probabilities(const VectorArg& state) const {
  VectorXd logs(experts.size());
  for (std::size_t k = 0; k < experts.size(); ++k) {
    const MixtureExpert& expert = experts[k];
    requireSize("state of an expert", state.size(), expert.meanState.size());
    logs[static_cast<Index>(k)] =
        std::log(expert.weight) + logNormals(state, expert.meanState, expert.stateCovariance)[0];
  }
  return (logs.array() - logSumExp(logs.transpose())).exp();
}

int MixturePolicy::expertFor(const VectorArg& state, std::optional<int> previous, Rng& rng) const {
  const VectorXd P = probabilities(state);
  if (previous && !(*previous >= 0 && *previous < P.size()))
    throw Error({.what = "previous expert",
                 .found = fmt::format("{}", *previous),
                 .wanted = fmt::format("one of 0 to {}", P.size() - 1)});
  if (previous && P[*previous] >= .1) return *previous;
  double left = rng.uniform();
  int expert = 0;
  while (expert + 1 < P.size() && (left -= P[expert]) >= 0) ++expert;
  return expert;
}

MixtureClone cloneMixture(const MatrixArg& states, const MatrixArg& actions, Rng& rng,
                          const MixtureCloneOptions& options) {
  requireCount("experts", options.experts, 1);
  requireCount("starts of expectation maximisation", options.starts, 1);
  requireCount("iterations of expectation maximisation", options.maxIterations, 1);
  requirePositive("tolerance of expectation maximisation", options.tolerance);
  requirePositive("regularisation of covariances", options.regularisation);
  requireCount("demonstrations", states.rows(), std::max(2, options.experts));
  requireSize("actions of the demonstrations", actions.rows(), states.rows());
  requireFiniteRows("states", states);
  requireFiniteRows("actions", actions);
  const Index d = states.cols(), n = states.rows();
  MatrixXd Z(d + actions.cols(), n);
  Z.topRows(d) = states.transpose();
  Z.bottomRows(actions.cols()) = actions.transpose();
  const VectorXd mean = Z.rowwise().mean();
  const VectorXd variances = (Z.colwise() - mean).rowwise().squaredNorm() / static_cast<double>(n);
  for (Index i = 0; i < Z.rows(); ++i)
    if (!(variances[i] > 1e-24 * mean[i] * mean[i]))
      throw Error({.what = i < d ? fmt::format("coordinate {} of the states", i)
                                 : fmt::format("coordinate {} of the actions", i - d),
                   .found = "the same number in all demonstrations",
                   .wanted = "one that changes"});
  const VectorXd penalty =
      options.regularisation * static_cast<double>(n) / static_cast<double>(options.experts) * variances;
  MixtureClone best;
  for (int start = 0; start < options.starts; ++start) {
    MixtureClone clone = runFrom(drawnMixture(Z, variances, options.experts, rng), Z, d, penalty, options);
    if (best.history.empty() || clone.history.back() > best.history.back()) best = std::move(clone);
  }
  return best;
}

}  // namespace rex
