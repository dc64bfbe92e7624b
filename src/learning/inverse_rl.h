#pragma once

#include <string>
#include <vector>

#include "learning/mdp.h"

namespace rex {

/// sum_t discount^t E phi(s_t) of a policy: k numbers. `features` is k x states, `start` a distribution over
/// states. Throws as discountedVisits, and Error for features of another number of states or not finite.
[[nodiscard]] Eigen::VectorXd featureExpectations(const Mdp& mdp, const MatrixArg& policy,
                                                  const MatrixArg& features, const VectorArg& start);

/// The same as the mean over demonstrations, each the states of one episode. Throws Error without any, for
/// unknown states, and a discount outside [0, 1].
[[nodiscard]] Eigen::VectorXd featureExpectations(const std::vector<std::vector<int>>& demonstrations,
                                                  const MatrixArg& features, double discount);

struct InverseRlOptions {
  double tolerance = 1e-6;  ///< of the margin, relative to the length of the teacher's expectations
  int maxIterations = 100;
};

enum class InverseRlStatus {
  kMatched,      ///< a mixture of the policies has the teacher's expectations, within the tolerance
  kUnmatched,    ///< no policy does: the teacher is better than all under w, or its few episodes were lucky
  kNotConverged  ///< all iterations are used up
};

struct InverseRlResult {
  InverseRlStatus status = InverseRlStatus::kNotConverged;
  Eigen::VectorXd w{};                      ///< k: R(s) = w^T phi(s) of the last margin above the tolerance
  std::vector<Eigen::MatrixXd> policies{};  ///< the candidates, the first of them uniform
  Eigen::VectorXd shares{};                 ///< the mixture of them nearest to the teacher: sum 1
  Eigen::VectorXd expectations{};           ///< k: of the mixture
  std::vector<double> margins{};            ///< one for each iteration; they do not grow
  std::string message{};
};

/// Rewards that explain a teacher, slides 9:12 and 9:13 (Abbeel and Ng 2004): in turn the weights w that set
/// the teacher's expectations apart from all candidates by most, and the policy that is best under w as one
/// more candidate. Whatever the true w is, if it has length one, the mixture is worth the teacher's within
/// the last margin. The rewards of `mdp` are not used. Throws as featureExpectations, Error for a discount of
/// one.
[[nodiscard]] InverseRlResult inverseRl(const Mdp& mdp, const MatrixArg& features, const VectorArg& start,
                                        const VectorArg& teacher, const InverseRlOptions& options = {});

}  // namespace rex
