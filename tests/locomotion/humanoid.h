#pragma once

#include "formats/scene_file.h"
#include "locomotion/walking_pattern.h"
#include "support/paths.h"

namespace rex {

/// The course's humanoid with bent knees, alone or in a scene to which something was added.
struct Humanoid {
  Model model;
  Legs legs{.leftFoot = model.body("left_foot"),
            .rightFoot = model.body("right_foot"),
            .trunk = model.body("pelvis"),
            .p_FS = {.03, 0, -.075}};
  Eigen::VectorXd start = model.initialPositions();

  explicit Humanoid(const SceneSpec& spec = scene()) : model(compile(spec)) {
    for (const Joint& joint : model.joints()) {
      if (joint.name.ends_with("_hip_pitch") || joint.name.ends_with("_ankle_pitch"))
        start[joint.qIndex] = -.35;
      if (joint.name.ends_with("_knee")) start[joint.qIndex] = .7;
      if (joint.type == JointType::kFree) start.segment<3>(joint.qIndex) = Eigen::Vector3d(0, 0, .84);
    }
  }

  static SceneSpec scene() {
    return readScene(sourcePath("data/robots/humanoid/humanoid.urdf"), {.freeBase = true}).spec;
  }

  /// The posture in which a walk begins.
  [[nodiscard]] Eigen::VectorXd home(WalkPlan plan) const {
    plan.footsteps.resize(2);
    return walkingPattern(model, legs, plan, start).Q.col(0);
  }
};

}  // namespace rex
