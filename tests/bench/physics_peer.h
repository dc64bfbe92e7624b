#pragma once

#include <functional>

#include <Eigen/Core>

namespace rex::bench {

/// Equal boxes on a plane: `columns` side by side, at `distance` from centre to centre, in rows.
struct Boxes {
  int columns = 5, rows = 4;
  double distance = 0.5;  ///< metres
  [[nodiscard]] Eigen::Vector3d center(int row, int column) const;
};
inline constexpr double kBoxEdge = 0.2, kBoxMass = 1;
inline constexpr double kPhysicsStep = 1e-3;  ///< seconds

/// The same boxes, hand-made with Bullet alone, with friction in both directions of a contact, as ours. A
/// step, and the height of the last box.
struct PhysicsPeer {
  std::function<void()> step;
  std::function<double()> height;
};
[[nodiscard]] PhysicsPeer bulletBoxes(const Boxes& boxes, int iterations);

}  // namespace rex::bench
