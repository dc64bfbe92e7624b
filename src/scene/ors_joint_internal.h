#pragma once

#include "scene/ors_attributes_internal.h"
#include "scene/scene_spec.h"

namespace rex::ors {

/// What a joint knows of the scene around it.
struct JointSurroundings {
  Pose X_WP, X_WC;                      ///< of the bodies it connects, as the file has them
  const JointSpec* followed = nullptr;  ///< the joint that its attribute 'mimic' names
};

/// Reads what the attributes say into a joint that has its name and its bodies. Throws Error at the
/// attribute that is wrong.
void readJoint(const Attributes& attributes, const JointSurroundings& around, JointSpec& joint,
               Diagnostics& notes);

/// The name of the joint that this one follows; empty: none.
[[nodiscard]] std::string readMimic(const Attributes& attributes);

/// Throws Error at the attribute that is wrong unless `joint` can follow `leader`, which its 'mimic' names.
void requireLeader(const Attributes& attributes, const JointSpec& joint, const JointSpec& leader);

}  // namespace rex::ors
