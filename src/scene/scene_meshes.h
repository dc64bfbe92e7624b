#pragma once

#include "scene/assets.h"
#include "scene/scene_file.h"

namespace rex {

/// Reads the meshes of all shapes that are described by one and have none yet, where `assets` finds them;
/// each file once. Throws Error with the place of the shape if it names no file, assets.find() does not find
/// it, or readMesh() refuses it.
void loadMeshes(SceneFile& scene, const Assets& assets);

}  // namespace rex
