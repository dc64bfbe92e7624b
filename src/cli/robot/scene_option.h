#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

#include "cli/project.h"
#include "collision/contacts.h"
#include "formats/scene_file.h"
#include "scene/model.h"

namespace rex::cli {

/// The options about a scene.
struct SceneOption {
  std::filesystem::path file{};  ///< see findScene()
  ReadOptions reading{};
  std::string shapes = "visible";  ///< which shapes are drawn: visible, contact or all
};

/// Throws UsageError for a free base or an SRDF with an .ors or MJCF file, which would have no effect.
void requireMeaning(const std::filesystem::path& file, const ReadOptions& reading);

/// The file that a user means. Throws UsageError where findScene() throws Error.
[[nodiscard]] std::filesystem::path sceneFilePath(const Project& project, const SceneOption& scene);

/// Reads the scene that a user means; its name is as typed, without folders. Prints the reader's notes.
/// Throws UsageError where findScene() and readScene() throw Error, and for unknown `shapes`.
[[nodiscard]] SceneSpec loadSpec(const Project& project, const SceneOption& scene);

/// The same, compiled. Also throws UsageError where compile() throws Error.
[[nodiscard]] Model loadScene(const Project& project, const SceneOption& scene);

/// The limit on pairs of shapes for a command: if all of them touch, their list takes seconds and 220 MB.
inline constexpr std::size_t kMostContactPairs = 200'000;

/// What may collide in a model; prints warnings about doubtful settings. Throws UsageError for more pairs
/// of shapes on different bodies, before allocating them, and if ContactModel throws Error.
[[nodiscard]] ContactModel sceneContactModel(const Model& model);

/// Prints collisionWarnings().
void noteCollisionWarnings(const Model& model);

}  // namespace rex::cli
