#pragma once

#include <filesystem>
#include <string>

#include "scene/scene_spec.h"

namespace rex {

/// The scene as .ors text that readOrs() reads back: the same tree, poses to about 1e-15, other numbers
/// exactly. Meshes that were found are named relative to `folder`, in which the text will be saved; without
/// a folder they are named as in the spec. Only meshes inside the asset root of the new location can be
/// read back. Shape names that the format cannot express are dropped. Throws Error, naming the item, for
/// such a name of a body or joint, for a mesh that is in no file, and for more joints than parseOrs()
/// accepts.
[[nodiscard]] std::string writeOrs(const SceneSpec& spec, const std::filesystem::path& folder = {});

}  // namespace rex
