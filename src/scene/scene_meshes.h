#pragma once

#include "scene/assets.h"
#include "scene/scene_file.h"

namespace rex {

/// Reads the meshes of all shapes that are described by one and have none yet, where `assets` finds them, and
/// makes the hulls of those in contact; each file once. Throws Error with the place of the shape if it names
/// no file, assets.find() does not find it, readMesh(), scaledMesh() or convexHull() refuses it, or it is one
/// too many: a scene has at most 4096 files of meshes, and six million vertices in all their sizes together.
/// With `allowMissingMeshes`, what is not found becomes a box of 0.1 m that keeps contact and the name of its
/// file and is marked `meshMissing`, with one warning for each package or folder. Materials of full
/// transparency become opaque, with one warning for each file, and are refused if `strict`.
void loadMeshes(SceneFile& scene, const Assets& assets, const ReadOptions& options = {});

}  // namespace rex
