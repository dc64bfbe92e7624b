#pragma once

#include "kinematics/task_map.h"
#include "scene/state.h"

namespace rex {

/// J' v (d): the acceleration of a map's value when the joints do not accelerate. Computed from differences
/// of J v along v, which works for every map and is accurate to about 1e-10 |v|^2 for lengths of metres,
/// except at a jump or kink of the map. Throws Error for wrong sizes and numbers that are not finite.
[[nodiscard]] Eigen::VectorXd velocityAcceleration(const Model& model, const State& state,
                                                   const TaskMap& map);

}  // namespace rex
