#pragma once

#include <optional>
#include <string>

#include "scene/model.h"
#include "scene/scene_spec.h"

// Changes to a scene before it is compiled. Bodies are given by name; if several share one, the first is
// meant. All functions throw Error, with the nearest names, for an unknown body.
namespace rex {

/// The same scene with the initial posture q (nq numbers in the order of compile(spec)). Throws Error for
/// the wrong size, and as compile().
[[nodiscard]] SceneSpec atPositions(SceneSpec spec, const VectorArg& q);

/// Removes the shapes whose mesh is in no file, such as height fields of MJCF, which no text of a scene can
/// name. Returns how many.
std::size_t removeMeshesWithoutFile(SceneSpec& spec);

/// X_WB of a body in the initial posture.
[[nodiscard]] Pose initialPose(const SceneSpec& spec, const std::string& body);

/// The same bodies at the same initial poses, but with `body` as the root: all joints between it and the
/// old root are reversed. A joint of one coordinate keeps its value; with several, the values change sign
/// or order; named postures are left out. Throws Error if one of these joints is attached to the world, is a
/// free joint with limits, an armature or a spring, or has several coordinates and mimics or is mimicked.
[[nodiscard]] SceneSpec reconfigureRoot(SceneSpec spec, const std::string& body);

}  // namespace rex
