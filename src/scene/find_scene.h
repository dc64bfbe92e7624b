#pragma once

#include <filesystem>

namespace rex {

/// The file that a user means by `scene`: a file, or one of the course's in the folder `library`, with or
/// without its ending: robots/NAME.ors, robots/NAME/NAME.urdf or scenes/NAME.ors. A file where the user is
/// comes first. Throws Error naming the nearest when there is none.
[[nodiscard]] std::filesystem::path findScene(const std::filesystem::path& scene,
                                              const std::filesystem::path& library);

}  // namespace rex
