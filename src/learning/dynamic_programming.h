#pragma once

#include <limits>
#include <string>
#include <vector>

#include "learning/mdp.h"

namespace rex {

/// Optimal values and actions. Where status is kNotConverged they are as good as `errorBound` says.
struct MdpSolution {
  MdpStatus status = MdpStatus::kNotConverged;
  Eigen::VectorXd V{};
  Eigen::MatrixXd Q{};         ///< states x actions, of V
  std::vector<int> actions{};  ///< the best in each state
  int iterations = 0;
  /// |V - V*| is at most this, in each state. With a discount of one there is no such bound: how far V is
  /// from solving Bellman's equation.
  double errorBound = std::numeric_limits<double>::infinity();
  std::vector<double> history{};  ///< greatest change of V in each iteration
  std::string message{};
};

struct ValueIterationOptions {
  double tolerance = 1e-10;  ///< for the error bound
  int maxIterations = 100000;
};
/// V <- max_a [R + discount P V] until the bound |V - V*| <= discount / (1 - discount) |change| reaches the
/// tolerance (Puterman 1994, 6.3), rounding included. Throws Error as requireMdp, for a discount of one,
/// which has no such bound, and options that are not positive.
[[nodiscard]] MdpSolution valueIteration(const Mdp& mdp, const ValueIterationOptions& options = {});

/// Evaluates exactly and improves until nothing does (Howard 1960). Begins with actions that lead to terminal
/// states, so that with a discount of one it is enough that these can be reached from everywhere; kEndless
/// where they cannot, or where going on for ever pays. Throws Error as requireMdp.
[[nodiscard]] MdpSolution policyIteration(const Mdp& mdp, int maxIterations = 1000);

}  // namespace rex
