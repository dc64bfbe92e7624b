#pragma once

#include <vector>

#include "scene/model.h"

namespace rex {

/// One level of a hierarchy: achieve J dq = dy. J: d x n. dy: d.
struct TaskLevel {
  Eigen::MatrixXd J;
  Eigen::VectorXd dy;
};

struct HierarchyOptions {
  Eigen::MatrixXd W{};  ///< n x n, symmetric and positive definite: the cost of posture changes; empty: Id
  Eigen::VectorXd a{};  ///< n: the preferred posture change where the levels leave freedom; empty: zero
  /// Singular values s of a level below this are replaced by damping^2 / s; in units of y per v, see
  /// hierarchicalStep.
  double damping = 1e-3;
};

/// The step under strict priorities: among the dq that best fulfil the first level, those that best fulfil
/// the second, and so on; of these, the one nearest to `a` in the metric W. It is the limit of slide 2:50
/// for precisions rho_1 >> rho_2 >> ..., computed by dq += (J2 N)# (dy2 - J2 dq) in the nullspace N of all
/// levels above (the printed form is not that limit: erratum 3). If a level is singular or in conflict
/// with those above, its share of dq stays bounded: |share|_W <= |dy - J dq| / damping for the dq of the
/// levels above. Singular values are those of J U^-1 for W = U^T U, within N; below 1e-10 |J U^-1| they
/// count as zero. Throws Error if sizes disagree, a number is not finite, W is not positive definite or
/// damping is negative.
[[nodiscard]] Eigen::VectorXd hierarchicalStep(const std::vector<TaskLevel>& levels,
                                               const HierarchyOptions& options = {});

}  // namespace rex
