#pragma once

#include <filesystem>

#include "cli/project.h"
#include "scene/model.h"

namespace rex::cli {

/// The scene that a user means by SCENE: an .ors file, or the name of a robot of the course, with or without
/// its ending; the model is called as typed, without folders. Prints what the reader noticed. Throws
/// UsageError naming the nearest robots when there is no such file, and as readOrs() and compile().
[[nodiscard]] Model loadScene(const Project& project, const std::filesystem::path& scene);

}  // namespace rex::cli
