#pragma once

#include <functional>

#include "kinematics/forward_kinematics.h"

namespace rex {

/// What task maps look at: a robot, its posture q (nq), and where that puts the bodies.
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

/// A task map phi (slide 2:52): writes y and J of a posture into storage that is used again and again, so
/// that resizing costs nothing after the first time. Any lambda of this form is one.
using TaskMap = std::function<void(const Posture&, TaskValue&)>;

}  // namespace rex
