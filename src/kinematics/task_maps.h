#pragma once

#include "geometry/rotation.h"
#include "kinematics/task_map.h"

namespace rex {

// The task maps of slides 2:52 to 2:64, except contacts (collision/contacts.h). A point Q or vector is
// fixed in body B and given in B's axes; values are in W unless stated otherwise; J is d x nv and exact.
// Maps copy their arguments. Position, orientation and pose allocate nothing once their storage was used.

/// p_WQ: 3, metres. Slide 2:53.
[[nodiscard]] TaskMap positionTask(BodyId body, const Eigen::Vector3d& p_BQ = Eigen::Vector3d::Zero());
/// The vector expressed in W: 3, in its own unit. Slide 2:54.
[[nodiscard]] TaskMap vectorTask(BodyId body, const Eigen::Vector3d& vector_B);
/// The orientation as a unit quaternion: 4 (w, x, y, z). Of q and -q it gives the one nearer to `nearest`,
/// so that it jumps only half a turn away from there. Pass the target as `nearest`, with any length; the
/// default gives w >= 0. Throws Error if `nearest` is zero or not finite. For distant targets,
/// orientationTask behaves better.
[[nodiscard]] TaskMap quaternionTask(BodyId body, const Quaternion& nearest = Quaternion::UnitX());
/// The orientation error relative to the target frame T: the rotation vector e with R_WB = exp(e) R_WT: 3,
/// radians, in W, |e| <= pi. It is zero at the target and jumps, changing sign, half a turn away from it.
[[nodiscard]] TaskMap orientationTask(BodyId body, const Eigen::Matrix3d& R_WT);
/// p_WQ - p_WT, then the error of orientationTask: 6, metres and radians. It is zero if B has the axes of T
/// and Q is at T's origin.
[[nodiscard]] TaskMap poseTask(BodyId body, const Pose& X_WT,
                               const Eigen::Vector3d& p_BQ = Eigen::Vector3d::Zero());

/// The vector from point P of body A to point Q of body B, in A's axes: 3, metres. Slide 2:55.
[[nodiscard]] TaskMap relativePositionTask(BodyId body, const Eigen::Vector3d& p_BQ, BodyId a,
                                           const Eigen::Vector3d& p_AP);
/// A vector of body B in the axes of body A: 3. Slide 2:56.
[[nodiscard]] TaskMap relativeVectorTask(BodyId body, const Eigen::Vector3d& vector_B, BodyId a);
/// The orientation R_AB as quaternionTask gives R_WB: 4. Throws as quaternionTask.
[[nodiscard]] TaskMap relativeQuaternionTask(BodyId body, BodyId a,
                                             const Quaternion& nearest = Quaternion::UnitX());

/// Scalar product of a vector of the body with one in W: 1. For unit vectors it is 1 if they are aligned, 0
/// if orthogonal, -1 if opposite. Slide 2:57.
[[nodiscard]] TaskMap alignmentTask(BodyId body, const Eigen::Vector3d& vector_B,
                                    const Eigen::Vector3d& vector_W);
/// Scalar product of vectors of two bodies: 1. Slide 2:58.
[[nodiscard]] TaskMap relativeAlignmentTask(BodyId body, const Eigen::Vector3d& vector_B, BodyId a,
                                            const Eigen::Vector3d& vector_A);

/// Sum over all coordinates of how far each is beyond its limits shrunk by `margin`, divided by `margin`:
/// 1. Slide 2:59. The margin is in the coordinates' units, radians or metres. Entries of quaternions have
/// no limits here. J is one-sided where a coordinate is exactly `margin` away. Throws Error unless margin
/// is finite and positive.
[[nodiscard]] TaskMap jointLimitsTask(double margin);
/// Centre of mass of the scene: 3, metres. Slide 2:61, which lacks the division by the mass. Evaluating it
/// throws Error for a scene without mass.
[[nodiscard]] TaskMap centerOfMassTask();
/// difference(model, home, q): nv. It is q - home of slide 2:62, but for quaternions the rotation vector
/// from home, in the moved frame. Evaluating it throws Error unless `home` has nq numbers.
[[nodiscard]] TaskMap homingTask(const VectorArg& home);

/// Some rows of a map, from row `first` on: its height is rowsOf(positionTask(body), 2, 1). Throws Error for
/// numbers below zero, and evaluating it for a map that has fewer rows.
[[nodiscard]] TaskMap rowsOf(const TaskMap& map, int first, int count);

}  // namespace rex
