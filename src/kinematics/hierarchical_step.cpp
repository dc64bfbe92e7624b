#include "kinematics/hierarchical_step.h"

#include <algorithm>

#include <Eigen/SVD>

#include "base/require.h"
#include "kinematics/inverse_kinematics_internal.h"

namespace rex {
namespace {

// Singular values below this share of the level's Jacobian are rounding errors: nothing can be done there.
constexpr double kRankTolerance = 1e-10;

// 1/s; below the damping, a bounded value that continues it without a jump.
double dampedInverse(double s, double damping) {
  const double divisor = std::max(s, damping);
  return s / (divisor * divisor);
}

// Moves x within the span of `free` towards J x = dy, and keeps in `free` the directions that J does not see.
void fulfil(const Eigen::MatrixXd& J, const Eigen::VectorXd& dy, double damping, Eigen::VectorXd& x,
            Eigen::MatrixXd& free) {
  if (free.cols() == 0) return;
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(J * free, Eigen::ComputeThinU | Eigen::ComputeFullV);
  const Eigen::VectorXd& s = svd.singularValues();
  const Eigen::Index rank = (s.array() > kRankTolerance * J.norm()).count();
  const auto V = svd.matrixV().leftCols(rank);
  Eigen::VectorXd coordinates = svd.matrixU().leftCols(rank).transpose() * (dy - J * x);
  for (Eigen::Index i = 0; i < rank; ++i) coordinates[i] *= dampedInverse(s[i], damping);
  x += free * (V * coordinates);
  free = Eigen::MatrixXd(free * svd.matrixV().rightCols(free.cols() - rank));
}

}  // namespace

Eigen::VectorXd hierarchicalStep(const std::vector<TaskLevel>& levels, const HierarchyOptions& options) {
  requireNotNegative("damping", options.damping);
  if (levels.empty())
    throw Error({.what = "hierarchy of tasks", .found = "no level", .wanted = "at least one"});
  const Eigen::Index n = levels.front().J.cols();
  const Eigen::MatrixXd U = internal::Metric("metric W", options.W, n).root();
  const auto triangle = U.triangularView<Eigen::Upper>();

  // In x = U dq the metric is the identity.
  Eigen::VectorXd x = Eigen::VectorXd::Zero(n);
  Eigen::MatrixXd free = Eigen::MatrixXd::Identity(n, n);
  for (const TaskLevel& level : levels) {
    requireSize("Jacobian of a level, per row", level.J.cols(), n);
    requireSize("task change dy of a level", level.dy.size(), level.J.rows());
    requireFinite("Jacobian of a level", level.J.reshaped());
    requireFinite("task change dy of a level", level.dy);
    fulfil(triangle.solve<Eigen::OnTheRight>(level.J), level.dy, options.damping, x, free);
  }
  if (options.a.size() > 0) {
    requireSize("desired posture change a", options.a.size(), n);
    requireFinite("desired posture change a", options.a);
    x += free * (free.transpose() * (U * options.a - x));
  }
  return triangle.solve(x);
}

}  // namespace rex
