#pragma once

#include <filesystem>
#include <string>

#include "cli/project.h"
#include "scene/model.h"
#include "scene/scene_file.h"

namespace rex::cli {

/// What a user says about a scene.
struct SceneOption {
  std::filesystem::path file{};  ///< see findScene()
  ReadOptions reading{};
  std::string shapes{};  ///< visible, contact or all: which of them are drawn; empty: visible
};

/// Throws UsageError for a free base or an SRDF of an .ors or MJCF file, which would have no effect.
void requireMeaning(const std::filesystem::path& file, const ReadOptions& reading);

/// The file that a user means. Throws UsageError as findScene() throws Error.
[[nodiscard]] std::filesystem::path fileOf(const Project& project, const SceneOption& scene);

/// Reads the scene that a user means; it is called as typed, without folders. Prints what the reader noticed.
/// Throws UsageError as findScene() and readScene() throw Error, or for unknown `shapes`.
[[nodiscard]] SceneSpec loadSpec(const Project& project, const SceneOption& scene);

/// The same, compiled. Throws UsageError also as compile() throws Error.
[[nodiscard]] Model loadScene(const Project& project, const SceneOption& scene);

}  // namespace rex::cli
