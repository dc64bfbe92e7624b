#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "base/diagnostic.h"
#include "scene/scene_spec.h"

namespace rex {

/// What a file holds, and what the reader noticed (ignored attributes, likely misspellings).
struct SceneFile {
  SceneSpec spec;
  Diagnostics notes;
  /// What was read, of which parseScene() makes the same again, but for meshes and an SRDF beside it; empty
  /// for a scene of several files.
  std::string text{};
};

struct ReadOptions {
  /// Holds all files that the scene names, see Assets; empty: its default.
  std::filesystem::path assetRoot{};
  bool allowMissingMeshes = false;        ///< boxes stand for them, and a warning says so
  bool freeBase = false;                  ///< of a URDF robot: its root moves freely
  bool textures = false;                  ///< of meshes, see readTexturedMesh(); for those who draw them
  bool strict = false;                    ///< faults that are repaired otherwise, with a warning, are errors
  Diagnostics* notesOfFailure = nullptr;  ///< where notes go that were made before an Error
  /// An SRDF that says which links of a URDF robot may collide; empty: NAME.srdf beside NAME.urdf, if there.
  std::filesystem::path srdf{};
};

/// Reads a scene with its meshes; the ending of the file, in any case, says how: .ors, .urdf, or .xml for
/// MuJoCo's MJCF. Throws Error: another ending, and as readOrs(), readUrdf() or readMjcf().
[[nodiscard]] SceneFile readScene(const std::filesystem::path& file, const ReadOptions& options = {});

/// The same for text at hand, which is .ors unless `name` ends in .urdf or .xml; of .xacro it throws Error.
/// Reads no file, so shapes know their mesh by name only.
[[nodiscard]] SceneFile parseScene(std::string_view text, const std::string& name,
                                   const ReadOptions& options = {});

/// The text of a scene file. Throws Error if it is missing, no file that can be read, or larger than `most`
/// bytes.
[[nodiscard]] std::string readSceneText(const std::filesystem::path& file, std::size_t most = 32u << 20);

}  // namespace rex
