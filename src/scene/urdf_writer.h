#pragma once

#include <filesystem>
#include <string>

#include "base/diagnostic.h"
#include "scene/scene_spec.h"

namespace rex {

/// A robot as URDF, and what of the scene URDF cannot say: one note for each kind of loss.
struct UrdfText {
  std::string text;
  Diagnostics notes;
};

/// Writes a scene as URDF. Bodies keep their names, poses and inertias (of several with one name all but the
/// first get a number), and joints their coordinates in their order; joints that URDF lacks become chains, as
/// share/doc/urdf.md says. Files of meshes are named relative to `folder` (empty: where they lie). Throws
/// Error as compile(), and for two joints of one name, a ball joint, a mimic of a planar or free joint,
/// characters in names that XML lacks, and what parseUrdf() refuses: too many joints, a name too long.
[[nodiscard]] UrdfText writeUrdf(const SceneSpec& spec, const std::filesystem::path& folder = {});

}  // namespace rex
