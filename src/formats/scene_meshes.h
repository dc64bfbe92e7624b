#pragma once

#include "formats/assets.h"
#include "formats/scene_file.h"

namespace rex {

/// Whether materials in mesh files colour a mesh, or only the shape does, as in MuJoCo.
enum class MeshMaterials { kUsed, kIgnored };

/// Reads the missing meshes of all shapes that are described by one, from the files that `assets` finds,
/// each once, and computes the hulls of shapes in contact. Throws Error with the position of the shape if
/// it names no file, if assets.find(), readMesh(), scaledMesh() or convexHull() throws, and for more than
/// 4096 mesh files or six million vertices in all their sizes together. With `allowMissingMeshes`, a mesh
/// that is not found becomes a box of 0.1 m that keeps its contact and file name and is marked
/// `meshMissing`, with one warning for each package or folder. Says how it reads Collada files with an up
/// axis other than z, see ReadOptions::upAxis. Fully transparent materials become opaque,
/// with one warning for each file, or are refused if `strict`.
void loadMeshes(SceneFile& scene, const Assets& assets, const ReadOptions& options = {},
                MeshMaterials materials = MeshMaterials::kUsed);

}  // namespace rex
