#include "learning/inverse_rl.h"

#include <fmt/format.h>

#include "base/error.h"
#include "base/require.h"
#include "learning/dynamic_programming.h"
#include "learning/max_margin.h"
#include "learning/policy_values.h"

namespace rex {
namespace {

void requireStateFeatures(const MatrixArg& features) {
  if (features.size() == 0)
    throw Error({.what = "features",
                 .found = fmt::format("{} x {}", features.rows(), features.cols()),
                 .wanted = "one column for each state"});
  for (Eigen::Index s = 0; s < features.cols(); ++s)
    if (!features.col(s).allFinite())
      throw Error({.what = fmt::format("features of state {}", s), .found = "entries that are not finite"});
}

void require(const Mdp& mdp, const MatrixArg& features, const VectorArg& teacher,
             const InverseRlOptions& options) {
  requireMdp(mdp);
  if (mdp.discount == 1)
    throw Error({.what = "discount of inverse learning", .found = "1", .wanted = "less than 1"});
  requireStateFeatures(features);
  requireSize("expectations of the teacher", teacher.size(), features.rows());
  requireFinite("expectations of the teacher", teacher);
  requirePositive("tolerance of inverse learning", options.tolerance);
  requireCount("maxIterations of inverse learning", options.maxIterations, 1);
}

// The best policy where being in s pays w^T phi(s).
Eigen::MatrixXd bestUnder(Mdp mdp, const MatrixArg& features, const Eigen::VectorXd& w) {
  mdp.rewards.colwise() = features.transpose() * w;
  return policyOf(mdp, policyIteration(mdp).actions);
}

Eigen::MatrixXd asColumns(const std::vector<Eigen::VectorXd>& columns) {
  Eigen::MatrixXd matrix(columns.front().size(), static_cast<Eigen::Index>(columns.size()));
  for (std::size_t i = 0; i < columns.size(); ++i) matrix.col(static_cast<Eigen::Index>(i)) = columns[i];
  return matrix;
}

}  // namespace

Eigen::VectorXd featureExpectations(const Mdp& mdp, const MatrixArg& policy, const MatrixArg& features,
                                    const VectorArg& start) {
  requireStateFeatures(features);
  requireSize("columns of the features, one for each state", features.cols(), mdp.states());
  return features * discountedVisits(mdp, policy, start);
}

Eigen::VectorXd featureExpectations(const std::vector<std::vector<int>>& demonstrations,
                                    const MatrixArg& features, double discount) {
  requireStateFeatures(features);
  if (!(discount >= 0 && discount <= 1))
    throw Error({.what = "discount", .found = fmt::format("{:g}", discount), .wanted = "a number in [0, 1]"});
  if (demonstrations.empty()) throw Error({.what = "demonstrations", .found = "none"});
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(features.rows());
  for (std::size_t i = 0; i < demonstrations.size(); ++i) {
    double weight = 1;
    for (const int s : demonstrations[i]) {
      if (s < 0 || s >= features.cols())
        throw Error({.what = fmt::format("state of demonstration {}", i),
                     .found = fmt::format("{}", s),
                     .wanted = fmt::format("one of 0 to {}", features.cols() - 1)});
      sum += weight * features.col(s);
      weight *= discount;
    }
  }
  return sum / static_cast<double>(demonstrations.size());
}

InverseRlResult inverseRl(const Mdp& mdp, const MatrixArg& features, const VectorArg& start,
                          const VectorArg& teacher, const InverseRlOptions& options) {
  require(mdp, features, teacher, options);
  InverseRlResult result;
  result.policies = {uniformPolicy(mdp)};
  result.w = Eigen::VectorXd::Zero(teacher.size());
  std::vector<Eigen::VectorXd> candidates{featureExpectations(mdp, result.policies.back(), features, start)};
  const double tolerance = options.tolerance * teacher.norm();
  for (int i = 0; i < options.maxIterations; ++i) {
    const MarginResult margin = maxMargin(teacher, asColumns(candidates));
    result.margins.push_back(margin.margin);
    result.shares = margin.shares;
    result.expectations = asColumns(candidates) * margin.shares;
    // Not the margin: it is too small for a point of the hull that is not yet the nearest one.
    if ((teacher - result.expectations).norm() <= tolerance) {
      result.status = InverseRlStatus::kMatched;
      break;
    }
    result.w = margin.w;
    const Eigen::MatrixXd policy = bestUnder(mdp, features, margin.w);
    const Eigen::VectorXd expectations = featureExpectations(mdp, policy, features, start);
    // If the best policy under w is no better than the mixture, w sets the teacher apart from all policies.
    if (margin.w.dot(expectations - result.expectations) <= .5 * tolerance) {
      result.status = InverseRlStatus::kUnmatched;
      break;
    }
    result.policies.push_back(policy);
    candidates.push_back(expectations);
  }
  result.shares.conservativeResizeLike(Eigen::VectorXd::Zero(static_cast<Eigen::Index>(candidates.size())));
  constexpr const char* kWords[] = {"the teacher is matched", "no policy matches the teacher",
                                    "not converged"};
  result.message = fmt::format("{}: margin {:.3g} with {} policies", kWords[static_cast<int>(result.status)],
                               result.margins.back(), candidates.size());
  return result;
}

}  // namespace rex
