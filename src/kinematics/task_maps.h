#pragma once

#include <functional>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "geometry/rotation.h"
#include "kinematics/forward_kinematics.h"

namespace rex {

/// The argument of task maps: a robot, its posture q (nq), and the poses of its bodies there.
struct Posture {
  const Model& model;
  const Eigen::VectorXd& q;
  const BodyPoses& poses;
};

/// Value y (d) of a task map, and its Jacobian J (d x nv, per unit of v).
struct TaskValue {
  Eigen::VectorXd y;
  Eigen::MatrixXd J;
};

/// A task map phi (slide 2:52): writes y and J of a posture into storage that is reused, so that resizing
/// costs nothing after the first time. Any lambda with this signature is one.
using TaskMap = std::function<void(const Posture&, TaskValue&)>;

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

/// Some rows of a map, from row `first` on: its height is taskRows(positionTask(body), 2, 1). Throws Error
/// for numbers below zero, and evaluating it for a map that has fewer rows.
[[nodiscard]] TaskMap taskRows(const TaskMap& map, int first, int count);

/// The tolerance of a task that is only weighed against others: no distance from its target is too large.
inline constexpr double kNoTolerance = std::numeric_limits<double>::infinity();

/// One of several things that a robot should do: bring the value of a task map to a target (slide 2:47).
struct Task {
  std::string name{};        ///< for messages
  TaskMap map{};             ///< gives y (d)
  Eigen::VectorXd target{};  ///< y* (d); empty: zero
  double precision = 1;      ///< rho > 0: the task costs rho |y - y*|^2
  double tolerance = 1e-6;   ///< the task is fulfilled if max |y - y*| is at most this; see kNoTolerance
};

/// The big task of slide 2:47: Phi, which stacks sqrt(rho_i) (y_i - y_i*) of all tasks, and its Jacobian.
/// Its target is zero and its metric the identity. Throws Error naming the task if it has no map, a
/// precision that is not positive or a negative tolerance, or if its value, Jacobian or target has the
/// wrong size or a number that is not finite.
[[nodiscard]] TaskValue stackTasks(std::span<const Task> tasks, const Posture& at);
/// Overload for hot loops. `values` becomes the unweighted value of each task, `phi` the stack. If the maps
/// do not allocate, neither does it, once both have been used with these tasks.
void stackTasks(std::span<const Task> tasks, const Posture& at, std::vector<TaskValue>& values,
                TaskValue& phi);

/// max |y - y*| of a task's value, in the unit of y.
[[nodiscard]] double taskError(const Task& task, const TaskValue& value);

}  // namespace rex
