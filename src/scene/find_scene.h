#pragma once

#include <filesystem>

namespace rex {

/// The file that a user means by `scene`: a path, or a scene of the course in the folder `library`, with or
/// without its extension: robots/NAME.ors, robots/NAME/NAME.urdf or scenes/NAME.ors. A file at that path
/// comes first. Throws Error with the nearest names if there is none.
[[nodiscard]] std::filesystem::path findScene(const std::filesystem::path& scene,
                                              const std::filesystem::path& library);

}  // namespace rex
