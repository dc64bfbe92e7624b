#pragma once

#include <span>

#include "kinematics/forward_kinematics.h"

namespace rex {

using Matrix6Xd = Eigen::Matrix<double, 6, Eigen::Dynamic>;

// Jacobians have one column for each of the nv entries of v and are expressed in the world frame W. `poses`
// are those of the posture.

/// p_WQ, the world position of the point Q fixed in body B at p_BQ, metres. Slide 2:53.
[[nodiscard]] Eigen::Vector3d position(const BodyPoses& poses, BodyId body, const Eigen::Vector3d& p_BQ);
/// Jacobian of that point: 3 x nv, metres per unit of v. Slides 2:22 and 2:23, as columns (erratum 2).
[[nodiscard]] Eigen::Matrix3Xd positionJacobian(const Model& model, const BodyPoses& poses, BodyId body,
                                                const Eigen::Vector3d& p_BQ);

/// The vector `vector_B`, fixed in body B, expressed in W. Slide 2:54.
[[nodiscard]] Eigen::Vector3d direction(const BodyPoses& poses, BodyId body, const Eigen::Vector3d& vector_B);
/// Jacobian of that direction: 3 x nv, per unit of v. Slide 2:54.
[[nodiscard]] Eigen::Matrix3Xd directionJacobian(const Model& model, const BodyPoses& poses, BodyId body,
                                                 const Eigen::Vector3d& vector_B);

/// Jacobian of the angular velocity of a body: 3 x nv, radians per second per unit of v; the matrix A of
/// slide 2:54.
[[nodiscard]] Eigen::Matrix3Xd angularJacobian(const Model& model, const BodyPoses& poses, BodyId body);

/// Both, positionJacobian() above angularJacobian(): 6 x nv.
[[nodiscard]] Matrix6Xd poseJacobian(const Model& model, const BodyPoses& poses, BodyId body,
                                     const Eigen::Vector3d& p_BQ);

/// Overloads for hot loops: the caller owns J, which must have its size already. They allocate nothing.
void positionJacobian(const Model& model, const BodyPoses& poses, BodyId body, const Eigen::Vector3d& p_BQ,
                      Eigen::Ref<Eigen::Matrix3Xd> J);
void angularJacobian(const Model& model, const BodyPoses& poses, BodyId body, Eigen::Ref<Eigen::Matrix3Xd> J);
void poseJacobian(const Model& model, const BodyPoses& poses, BodyId body, const Eigen::Vector3d& p_BQ,
                  Eigen::Ref<Matrix6Xd> J);

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
