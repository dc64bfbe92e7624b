#pragma once

#include <vector>

#include <Eigen/Core>

namespace rex {

/// The column assigned to each row such that no two rows share one and the sum of their costs is minimal:
/// shortest augmenting paths with potentials (Kuhn 1955, Munkres 1957; Jonker and Volgenant 1987). Throws
/// Error for costs that are not finite and for more rows than columns.
[[nodiscard]] std::vector<int> cheapestAssignment(const Eigen::MatrixXd& cost);

}  // namespace rex
