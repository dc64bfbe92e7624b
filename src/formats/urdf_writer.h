#pragma once

#include <filesystem>
#include <string>

#include "base/error.h"
#include "scene/scene_spec.h"

namespace rex {

/// A robot as URDF, with one note for each kind of content that URDF cannot express.
struct UrdfText {
  std::string text;
  Diagnostics notes;
};

/// Writes a scene as URDF. Bodies keep their names (duplicates get a number), poses and inertias; joints
/// keep their coordinates and their order. Joint types that URDF lacks become chains, as described in
/// share/doc/robot-files.md. Mesh files are named relative to `folder` (empty: by their meshPath). Throws
/// Error as compile(), and for two joints with one name, a ball joint, a mimic of a planar or free joint,
/// names with characters that XML does not allow, and more joints or longer names than parseUrdf() accepts.
[[nodiscard]] UrdfText writeUrdf(const SceneSpec& spec, const std::filesystem::path& folder = {});

}  // namespace rex
