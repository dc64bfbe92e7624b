#pragma once

#include <optional>

#include "kinematics/task_maps.h"
#include "scene/model.h"

namespace rex {

/// Where a point of a body, p_BQ in its frame, is dragged to, in W, metres; and the wanted
/// orientation of its frame.
struct DragGoal {
  BodyId body{};
  Eigen::Vector3d p_BQ{0, 0, 0}, p_WQ{0, 0, 0};
  std::optional<Eigen::Matrix3d> R_WB{};
};

/// A posture (nq) nearer to the goal, within the limits of the joints: by at most `steps` damped steps of
/// inverse kinematics from q (slide 2:29), each of which aims at most 0.1 m farther and leads nearer. Joints
/// at a limit rest there. Free joints do not move if the body hangs on others. `avoid`, if any, is a cost
/// such as contactTask(), weighed against the distance as if 1 were 2 cm. Throws Error for numbers that are
/// not finite.
[[nodiscard]] Eigen::VectorXd dragged(const Model& model, const Eigen::VectorXd& q, const DragGoal& goal,
                                      const std::optional<TaskMap>& avoid = {}, int steps = 20);

}  // namespace rex
