#pragma once

#include <filesystem>
#include <string>

#include "render/film.h"

namespace rex {

/// The film as a binary glTF 2.0 file (.glb), which browsers and 3-D programs play. Every solid is a node
/// with its name, moved by an animation in seconds from 0. A solid that changes its form, or comes and
/// goes, has one node for each form, shown or hidden by a scale of 1 or 0. Texts and widths in pixels are
/// stored as extras. `view` is the direction of the camera, as in framing(). Throws Error for a film that
/// is empty or shows only ground, for times that do not increase, and as requireDrawable().
[[nodiscard]] std::string toGlb(const Film& film, const Eigen::Vector3d& view = kDefaultView);

/// Writes toGlb() to a file, which appears whole or not at all. Throws Error naming the path.
void writeGlb(const Film& film, const std::filesystem::path& path,
              const Eigen::Vector3d& view = kDefaultView);

}  // namespace rex
