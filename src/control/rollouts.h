#pragma once

#include <cstdint>

#include <Eigen/Core>

namespace rex {

/// The initial state of a plant with four states, and the seed of its noise. Comparing policies on the same
/// trials takes luck out of the comparison.
struct Trial {
  Eigen::Vector4d start{0, 0, 0, 0};
  std::uint64_t seed = 0;
};

/// The results of all policies, one per column, in all trials, one per row.
struct Rollouts {
  Eigen::MatrixXd cost{};   ///< summed over the steps, including the cost of failing
  Eigen::MatrixXi steps{};  ///< number of steps survived
};

}  // namespace rex
