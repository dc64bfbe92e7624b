#pragma once

#include "kinematics/motion_profile.h"
#include "kinematics/task_maps.h"

namespace rex {

/// The straight path from posture q0 to qT (slide 2:41): nq x (steps + 1); column t is the posture at time
/// t / steps. Quaternions turn about one axis, the short way. Throws Error unless steps > 0, and for wrong
/// sizes.
[[nodiscard]] Eigen::MatrixXd interpolatePostures(const Model& model, const VectorArg& q0,
                                                  const VectorArg& qT, int steps,
                                                  const MotionProfile& profile = {});

/// The straight path from task value y0 to yT, both d (slide 2:42): d x (steps + 1). Throws as above.
[[nodiscard]] Eigen::MatrixXd interpolateValues(const VectorArg& y0, const VectorArg& yT, int steps,
                                                const MotionProfile& profile = {});

/// A motion that follows a task, and the error of each posture: max |y - y*|, in y's unit.
struct FollowedTask {
  Eigen::MatrixXd Q;       ///< nq x (T + 1), from the start
  Eigen::VectorXd errors;  ///< T + 1
};

/// Follows targets by one step of inverse kinematics each (slide 2:42, with other tasks 2:48): q_t from
/// q_{t-1}, towards column t of Y (d x (T + 1)) and the targets of `others`, with the metric W (nv x nv,
/// empty: Id), within the joint limits. The target of `followed` itself is not used. Column 0 of Y is used
/// for the error at q0 only. Throws as stackTasks, and for a q0 of the wrong size or a W that is not
/// positive definite.
[[nodiscard]] FollowedTask followTask(const Model& model, const Task& followed, const MatrixArg& Y,
                                      const VectorArg& q0, const std::vector<Task>& others = {},
                                      const Eigen::MatrixXd& W = {});

}  // namespace rex
