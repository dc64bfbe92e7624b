#pragma once

#include "geometry/rotation.h"
#include "kinematics/task_map.h"

namespace rex {

// The task maps of slides 2:52 to 2:64, but for contacts (collision/contacts.h). A point Q or vector is fixed
// in body B and given in B's axes; values are in W unless said otherwise; J is d x nv, exact. Maps copy what
// they are given. Position, orientation and pose allocate nothing once their storage has been used.

/// p_WQ, 3, metres. Slide 2:53.
[[nodiscard]] TaskMap positionTask(BodyId body, const Eigen::Vector3d& p_BQ = Eigen::Vector3d::Zero());
/// The vector seen from W, 3, in its own unit. Slide 2:54.
[[nodiscard]] TaskMap vectorTask(BodyId body, const Eigen::Vector3d& vector_B);
/// The orientation as a unit quaternion, 4 (w, x, y, z): of q and -q the one on the side of `nearest`, so
/// that it jumps half a turn away from there; the default gives w >= 0. Pass the target. `nearest`: any
/// length; throws Error if it is zero or not finite. For targets far away orientationTask is better behaved.
[[nodiscard]] TaskMap quaternionTask(BodyId body, const Quaternion& nearest = Quaternion::UnitX());
/// How far the body is turned away from the target frame T: the rotation vector e with R_WB = exp(e) R_WT, 3,
/// radians, in W, |e| <= pi. Zero at the target; it jumps half a turn away from it, where its two signs meet.
[[nodiscard]] TaskMap orientationTask(BodyId body, const Eigen::Matrix3d& R_WT);
/// p_WQ - p_WT, then the error of orientationTask: 6, metres and radians, zero where B has the axes of T and
/// Q lies at T's origin.
[[nodiscard]] TaskMap poseTask(BodyId body, const Pose& X_WT,
                               const Eigen::Vector3d& p_BQ = Eigen::Vector3d::Zero());

/// Point Q of body B measured from point P of body A, in A's axes: 3, metres. Slide 2:55.
[[nodiscard]] TaskMap relativePositionTask(BodyId body, const Eigen::Vector3d& p_BQ, BodyId a,
                                           const Eigen::Vector3d& p_AP);
/// A vector of body B seen from body A, 3. Slide 2:56.
[[nodiscard]] TaskMap relativeVectorTask(BodyId body, const Eigen::Vector3d& vector_B, BodyId a);
/// The orientation R_AB as quaternionTask gives R_WB, 4. Throws as that.
[[nodiscard]] TaskMap relativeQuaternionTask(BodyId body, BodyId a,
                                             const Quaternion& nearest = Quaternion::UnitX());

/// Scalar product of a vector of the body with one of W, 1. Of unit vectors: 1 aligned, 0 orthogonal, -1
/// opposite. Slide 2:57.
[[nodiscard]] TaskMap alignmentTask(BodyId body, const Eigen::Vector3d& vector_B,
                                    const Eigen::Vector3d& vector_W);
/// Scalar product of vectors of two bodies, 1. Slide 2:58.
[[nodiscard]] TaskMap relativeAlignmentTask(BodyId body, const Eigen::Vector3d& vector_B, BodyId a,
                                            const Eigen::Vector3d& vector_A);

/// Sum over all coordinates of how far they are within `margin` of a limit or beyond it, in margins: 1. Slide
/// 2:59. The margin is in the coordinates' units, radians or metres. Numbers of quaternions have no limits
/// here. J is that of one side where a coordinate is just `margin` away. Throws Error unless margin is
/// finite and positive.
[[nodiscard]] TaskMap jointLimitsTask(double margin);
/// Centre of mass of the scene, 3, metres, divided by the mass (slide 2:61 is not). Evaluating it throws
/// Error for a scene without mass.
[[nodiscard]] TaskMap centerOfMassTask();
/// difference(model, home, q), nv: q - home of slide 2:62, but at quaternions the rotation vector from home,
/// in the moved frame. Evaluating it throws Error unless `home` has nq numbers.
[[nodiscard]] TaskMap homingTask(const VectorArg& home);

}  // namespace rex
