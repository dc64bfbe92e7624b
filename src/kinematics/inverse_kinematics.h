#pragma once

#include "scene/model.h"

namespace rex {

/// One regularised step of inverse kinematics with W = Id and C = Id / sigma^2 (slide 2:29):
/// dq = (J^T J + sigma^2 Id)^-1 J^T dy, the posture change that best achieves the task change dy. J: d x n.
/// dy: d. Returns n numbers. Throws Error if the sizes disagree or sigma is not positive.
[[nodiscard]] Eigen::VectorXd inverseKinematicsStep(const Eigen::Ref<const Eigen::MatrixXd>& J,
                                                    const VectorArg& dy, double sigma);

/// The two equal forms of slide 2:29: (J^T C J + W)^-1 J^T C solves n equations, W^-1 J^T (J W^-1 J^T +
/// C^-1)^-1 solves d. kCheaper takes the second if W is diagonal and d < n.
enum class StepForm { kCheaper, kJointSpace, kTaskSpace };

/// The weights of a step. An empty matrix is the identity, an empty vector zero.
struct StepOptions {
  Eigen::MatrixXd W{};  ///< n x n, symmetric and positive definite: the cost of posture changes
  Eigen::MatrixXd C{};  ///< d x d, symmetric and positive definite: the cost of task errors
  Eigen::VectorXd a{};  ///< n: the preferred posture change where the task leaves freedom
  StepForm form = StepForm::kCheaper;
};

/// The dq that minimises |dq - a|_W^2 + |J dq - dy|_C^2, which is J# dy + (Id - J# J) a (slides 2:29, 2:36).
/// J: d x n. dy: d. Returns n numbers. With the stack of several tasks (stackTasks), dy = -Phi and C = Id it
/// is the step of slide 2:48. Throws Error if sizes disagree or W or C is not positive definite.
[[nodiscard]] Eigen::VectorXd inverseKinematicsStep(const MatrixArg& J, const VectorArg& dy,
                                                    const StepOptions& options);

}  // namespace rex
