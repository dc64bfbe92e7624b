#pragma once

#include <Eigen/Core>

namespace rex {

class Simulator;

/// The distances of pairs of shapes, and their Jacobian by the joint velocities.
struct Clearances {
  Eigen::VectorXd y;  ///< metres, negative in overlap
  Eigen::MatrixXd J;  ///< pairs x n; one-sided where the nearest points jump
};

/// Of all pairs of shapes that may collide, in the order of ContactModel::pairs(), at the simulator's
/// posture. Throws Error if a shape that may collide has no mesh.
[[nodiscard]] Clearances clearances(const Simulator& simulator);

}  // namespace rex
