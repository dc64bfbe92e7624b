#pragma once

#include <limits>
#include <string>
#include <vector>

#include "learning/mdp.h"

namespace rex {

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
