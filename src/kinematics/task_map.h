#pragma once

#include <functional>

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

}  // namespace rex
