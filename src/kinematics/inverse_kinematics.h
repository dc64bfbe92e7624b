#pragma once

#include "scene/model.h"

namespace rex {

/// One regularised step of inverse kinematics with W = Id and C = Id / sigma^2 (slide 2:29):
/// dq = (J^T J + sigma^2 Id)^-1 J^T dy, the posture change that best brings about the task change dy.
/// J: d x n. dy: d. Returns n numbers. Throws Error if the sizes disagree or sigma is not positive.
[[nodiscard]] Eigen::VectorXd inverseKinematicsStep(const Eigen::Ref<const Eigen::MatrixXd>& J,
                                                    const VectorArg& dy, double sigma);

}  // namespace rex
