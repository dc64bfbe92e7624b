#pragma once

#include <functional>

#include <Eigen/Core>

namespace rex::bench {

/// Nearest of points, one per column, by nanoflann. Empty: it is not installed.
struct NeighborPeer {
  /// The nearest to question k of all points, which its tree knows from the start.
  std::function<int(Eigen::Index k)> nearest{};
  /// Adds one point after the other and asks for the nearest to the questions in turn, once for each. Returns
  /// the sum of the answers.
  std::function<int()> grow{};
};

#ifdef REX_WITH_NANOFLANN
/// In 3, 7 or 12 dimensions.
[[nodiscard]] NeighborPeer nanoflannPeer(const Eigen::MatrixXd& points, const Eigen::MatrixXd& questions);
#else
[[nodiscard]] inline NeighborPeer nanoflannPeer(const Eigen::MatrixXd&, const Eigen::MatrixXd&) { return {}; }
#endif

}  // namespace rex::bench
