#pragma once

#include <filesystem>
#include <string>

#include "scene/scene_spec.h"

namespace rex {

/// The scene as .ors text that readOrs() reads back: same tree, poses to some 1e-15, other numbers to the
/// last digit. Meshes that were found are named relative to `folder`, where the text shall lie; without a
/// folder as they are called in the spec. Shapes whose name the format has no words for lose it. Throws
/// Error, naming the thing, for such a name of a body or joint, for a mesh that is in no file, and for what
/// parseOrs() refuses: too many joints.
/// Read again, only meshes load that lie in the asset root of the new place.
[[nodiscard]] std::string writeOrs(const SceneSpec& spec, const std::filesystem::path& folder = {});

}  // namespace rex
