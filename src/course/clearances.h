#pragma once

#include <Eigen/Core>

namespace rex {

class Simulator;

/// The distances of pairs of shapes, and their Jacobian with respect to the joint velocities.
struct Clearances {
  Eigen::VectorXd y;  ///< metres, negative in overlap
  Eigen::MatrixXd J;  ///< pairs x n; one-sided where the nearest points jump
};

/// The clearances of all pairs of shapes that may collide, in the order of ContactModel::pairs(), at the
/// simulator's posture. Throws Error if a shape that may collide lacks the mesh it needs.
[[nodiscard]] Clearances clearances(const Simulator& simulator);

}  // namespace rex
