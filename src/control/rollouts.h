#pragma once

#include <cstdint>

#include <Eigen/Core>

namespace rex {

/// Where a plant with four states starts, and what seeds its noise. Comparing policies on the same trials
/// takes the luck out of it.
struct Trial {
  Eigen::Vector4d start = Eigen::Vector4d::Zero();
  std::uint64_t seed = 0;
};

/// What became of all policies, one per column, in all trials, one per row.
struct Rollouts {
  Eigen::MatrixXd cost{};   ///< summed over the steps, with what failing costs
  Eigen::MatrixXi steps{};  ///< how many were survived
};

}  // namespace rex
