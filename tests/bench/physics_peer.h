#pragma once

#include <functional>

#include <Eigen/Core>

namespace rex::bench {

/// Edge length, distance and mass of the boxes that lie on the plane, five in a row.
inline constexpr int kBoxes = 20;
inline constexpr double kBoxEdge = 0.2, kBoxDistance = 0.5, kBoxMass = 1;
inline constexpr double kPhysicsStep = 1e-3;  ///< seconds

/// The same boxes, hand-made with Bullet alone, which does the same work: as many iterations, and friction in
/// both directions of a contact. A step, and the height of the last box.
struct PhysicsPeer {
  std::function<void()> step;
  std::function<double()> height;
};
[[nodiscard]] PhysicsPeer bulletBoxes(int iterations);

}  // namespace rex::bench
