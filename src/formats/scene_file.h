#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "base/error.h"
#include "scene/scene_spec.h"

namespace rex {

/// The content of a file, and what the reader noticed (ignored attributes, likely misspellings).
struct SceneFile {
  SceneSpec spec;
  Diagnostics notes;
  /// The text that was read, from which parseScene() makes the same scene again, except for meshes and an
  /// SRDF beside it; empty for a scene of several files.
  std::string text{};
};

/// What becomes of the up axis that Collada files give for their meshes. `kAsUsual`: of a URDF robot it is
/// ignored, as ROS does, so that meshes have the axes of their files; otherwise meshes are turned to z up.
enum class UpAxis { kAsUsual, kRespected, kIgnored };

struct ReadOptions {
  /// The folder that holds all files that the scene names, see Assets; empty: its default.
  std::filesystem::path assetRoot{};
  bool allowMissingMeshes = false;        ///< boxes replace them, with a warning
  bool freeBase = false;                  ///< for a URDF robot: its root moves freely
  bool textures = false;                  ///< read those of meshes, see readTexturedMesh(); for drawing
  bool strict = false;                    ///< faults that are otherwise repaired with a warning are errors
  Diagnostics* notesOfFailure = nullptr;  ///< receives the notes made before an Error
  /// An SRDF that says which links of a URDF robot may collide; empty: NAME.srdf beside NAME.urdf or in
  /// ../srdf, if any.
  std::filesystem::path srdf{};
  UpAxis upAxis = UpAxis::kAsUsual;
};

/// Reads a scene with its meshes. The file extension, in upper or lower case, says how: .ors, .urdf, or
/// .xml for MuJoCo's MJCF. Throws Error for another extension, and as readOrs(), readUrdf() or readMjcf().
[[nodiscard]] SceneFile readScene(const std::filesystem::path& file, const ReadOptions& options = {});

/// The same for text in memory, which is .ors unless `name` ends in .urdf or .xml; throws Error for .xacro.
/// Reads no file, so shapes know their mesh by name only.
[[nodiscard]] SceneFile parseScene(std::string_view text, const std::string& name,
                                   const ReadOptions& options = {});

/// Merges findings that differ only in quoted names and in numbers into the first of them, with their
/// number.
[[nodiscard]] Diagnostics grouped(const Diagnostics& notes);

/// The text of a scene file. Throws Error if it is missing, not a readable file, or larger than `most`
/// bytes.
[[nodiscard]] std::string readSceneText(const std::filesystem::path& file, std::size_t most = 32u << 20);

}  // namespace rex
