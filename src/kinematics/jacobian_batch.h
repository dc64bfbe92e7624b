#pragma once

#include <span>

#include "kinematics/pose_batch.h"

namespace rex {

/// A Jacobian with 3 rows at many configurations, in blocks of 8: [block][column][3][8].
class JacobianBatch {
 public:
  static constexpr int kLanes = PoseBatch::kLanes;

  /// Does not keep the numbers. Allocates nothing if there were at least as many before.
  void resize(int columns, int count) { numbers_.resize(columns, count); }
  int columns() const { return numbers_.items(); }
  /// The number of configurations, and of the blocks that hold them.
  int count() const { return numbers_.count(); }
  int blocks() const { return numbers_.blocks(); }

  /// The Jacobian at configuration k, 3 x columns().
  [[nodiscard]] Eigen::Matrix3Xd jacobian(int k) const;

  /// The numbers of a column in block b; those of the next column follow.
  std::span<const double, 3 * kLanes> block(int b, int column) const {
    return std::span<const double, 3 * kLanes>(numbers_.block(b, column), 3 * kLanes);
  }
  std::span<double, 3 * kLanes> block(int b, int column) {
    return std::span<double, 3 * kLanes>(numbers_.block(b, column), 3 * kLanes);
  }

 private:
  LaneBlocks<3> numbers_;
};

/// positionJacobian() at all configurations of `poses`, with the same bits: nv columns, metres per unit of v.
/// Allocates nothing once `out` has been used with this model and as many configurations.
void positionJacobianBatch(const Model& model, const PoseBatch& poses, BodyId body,
                           const Eigen::Vector3d& p_BQ, JacobianBatch& out);
/// The same for angularJacobian(): nv columns, radians per unit of v.
void angularJacobianBatch(const Model& model, const PoseBatch& poses, BodyId body, JacobianBatch& out);

}  // namespace rex
