#pragma once

#include <limits>
#include <string>

#include "learning/mdp.h"

namespace rex {

/// V is empty unless status is kSolved.
struct PolicyValues {
  MdpStatus status = MdpStatus::kNotConverged;
  Eigen::VectorXd V{};
  /// The largest violation of Bellman's equation, relative to the largest value.
  double residual = std::numeric_limits<double>::infinity();
  std::string message{};
};

/// The values of a policy from one linear system, V = R_pi + discount P_pi V: eq. (9) of exercise 12.10.
/// kEndless with a discount of one if some state, named in the message, may never reach a terminal one.
/// Throws Error like requireMdp and requirePolicy.
[[nodiscard]] PolicyValues policyValues(const Mdp& mdp, const MatrixArg& policy);

/// The expected discounted number of visits of each state, sum_t discount^t P(s_t), starting from a
/// distribution over states. Throws like policyValues, for a start that is not a distribution, and if there
/// are no values.
[[nodiscard]] Eigen::VectorXd discountedVisits(const Mdp& mdp, const MatrixArg& policy,
                                               const VectorArg& start);

/// Throws Error unless `start` is a distribution over the states.
void requireStart(const Mdp& mdp, const VectorArg& start);

}  // namespace rex
