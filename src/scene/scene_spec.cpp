#include "scene/scene_spec.h"

namespace rex {

std::string_view toString(CollisionRule rule) {
  return rule == CollisionRule::kFourGenerations ? "four_generations" : "all_but_neighbours";
}

Eigen::VectorXd JointSpec::start() const { return q0.size() > 0 ? q0 : jointCoordinates(type, axis, Pose{}); }

}  // namespace rex
