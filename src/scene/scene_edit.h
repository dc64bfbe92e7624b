#pragma once

#include <optional>
#include <string>

#include "scene/model.h"
#include "scene/scene_spec.h"

// Changes to a scene before it is compiled. Bodies are named; of several with one name the first is meant.
// All functions throw Error, with the nearest names, for a body that is not there.
namespace rex {

/// The same scene, whose initial posture is q (nq numbers in the order of compile(spec)). Throws Error for
/// another size, and as compile().
[[nodiscard]] SceneSpec atPositions(SceneSpec spec, const VectorArg& q);

/// X_WB of a body in the initial posture.
[[nodiscard]] Pose initialPose(const SceneSpec& spec, const std::string& body);

/// The same bodies in the same initial places, but hung up at `body`: all joints between it and its root are
/// turned round, so that it becomes the root. Joints of one coordinate keep its value; of others the values
/// change sign or place. Throws Error if a joint of the world is among them, a free joint with limits, or a
/// joint of several coordinates that mimics or is mimicked.
[[nodiscard]] SceneSpec reconfigureRoot(SceneSpec spec, const std::string& body);

/// A scene in which a body is held, and the joint it hung on before, if any.
struct Glued {
  SceneSpec spec;
  std::optional<JointSpec> former;
};

/// Holds `child` at `parent` (or "world") as they stand in the initial posture, by a rigid joint called
/// "PARENT>CHILD". The joint that `child` hung on is taken away. Throws Error if another joint mimics that
/// one, if the name of the new joint is taken, or if `parent` hangs on `child`.
[[nodiscard]] Glued glueBodies(SceneSpec spec, const std::string& parent, const std::string& child);

/// Undoes glueBodies(): takes away the rigid joint of `child` and puts `former` back, with the coordinates
/// that come nearest to where the body stands now. Without `former` the body becomes a root that stands where
/// it stood. Throws Error if `child` does not hang on a rigid joint, and if `former` mimics another joint.
[[nodiscard]] SceneSpec unglueBody(SceneSpec spec, const std::string& child,
                                   const std::optional<JointSpec>& former = {});

}  // namespace rex
