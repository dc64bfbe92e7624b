#pragma once

#include <vector>

#include "scene/model.h"

namespace rex {

/// One level of a hierarchy: bring about J dq = dy. J: d x n. dy: d.
struct TaskLevel {
  Eigen::MatrixXd J;
  Eigen::VectorXd dy;
};

struct HierarchyOptions {
  Eigen::MatrixXd W{};  ///< n x n, symmetric and positive definite: the price of posture changes; empty: Id
  Eigen::VectorXd a{};  ///< n: the posture change wished for where all levels leave a choice; empty: zero
  double damping =
      1e-3;  ///< singular values of a level below this are divided through as if they were larger
};

/// Strict priorities: the dq that fulfils the first level as well as it can be, of those the one that best
/// fulfils the second, and so on; then nearest to `a` in W. The limit of slide 2:50 for precisions rho_1 >>
/// rho_2 >> ..., by dq += (J2 N)# (dy2 - J2 dq) in the nullspace N of all levels above (see the errata: the
/// printed form is not). Where a level is singular, or in conflict with those above, its step stays bounded
/// by |dy| / damping. Throws Error if sizes disagree, W is not positive definite or damping is negative.
[[nodiscard]] Eigen::VectorXd hierarchicalStep(const std::vector<TaskLevel>& levels,
                                               const HierarchyOptions& options = {});

}  // namespace rex
