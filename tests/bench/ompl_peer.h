#pragma once

#include <functional>

#include <Eigen/Core>

namespace rex::bench {

/// Lengths of shortest ways of cars with turning radius 1 between poses (x, y, heading), by OMPL. Empty: it
/// is not installed.
struct CurvePeer {
  using Length = std::function<double(const Eigen::Vector3d& from, const Eigen::Vector3d& to)>;
  Length dubins{}, reedsShepp{};
};

#ifdef REX_WITH_OMPL
[[nodiscard]] CurvePeer omplCurvePeer();
#else
[[nodiscard]] inline CurvePeer omplCurvePeer() { return {}; }
#endif

}  // namespace rex::bench
