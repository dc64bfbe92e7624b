#pragma once

#include <filesystem>

#include "scene/scene_spec.h"

namespace rex {

/// Reads the meshes of all shapes that are described by one and have none yet. A relative `meshFile` lies in
/// `folder`. The frame of a shape of type kMesh moves to the mean of its vertices, so that it stays where it
/// is. Throws Error with the place of the shape and the file that was tried if it names none or readMesh()
/// refuses it.
void loadMeshes(SceneSpec& spec, const std::filesystem::path& folder);

}  // namespace rex
