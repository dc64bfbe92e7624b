#pragma once

#include <limits>
#include <string>
#include <vector>

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

/// Optimal values and actions. If status is kNotConverged they are accurate to `errorBound`.
struct MdpSolution {
  MdpStatus status = MdpStatus::kNotConverged;
  Eigen::VectorXd V{};
  Eigen::MatrixXd Q{};         ///< states x actions, computed from V
  std::vector<int> actions{};  ///< the best in each state
  int iterations = 0;
  /// Bound on |V - V*| in each state. With a discount of one there is no such bound, and this is the
  /// residual of Bellman's equation.
  double errorBound = std::numeric_limits<double>::infinity();
  std::vector<double> history{};  ///< largest change of V in each iteration
  std::string message{};
};

struct ValueIterationOptions {
  double tolerance = 1e-10;  ///< for the error bound
  int maxIterations = 100000;
};
/// V <- max_a [R + discount P V] until the bound |V - V*| <= discount / (1 - discount) |change| reaches the
/// tolerance (Puterman 1994, 6.3), including rounding. Throws Error like requireMdp, for a discount of one,
/// which has no such bound, and for options that are not positive.
[[nodiscard]] MdpSolution valueIteration(const Mdp& mdp, const ValueIterationOptions& options = {});

/// Alternates exact evaluation and improvement until the policy is stable (Howard 1960). It starts with
/// actions that lead to terminal states, so with a discount of one these must only be reachable from every
/// state. Returns kEndless if they are not, or if going on forever pays. Throws Error like requireMdp.
[[nodiscard]] MdpSolution policyIteration(const Mdp& mdp, int maxIterations = 1000);

}  // namespace rex
