#pragma once

#include "gallery/pictures.h"

namespace rex::gallery {

/// The robots and scenes of the folder data, in the order of the page.
[[nodiscard]] std::vector<Drawing> robotPictures();

}  // namespace rex::gallery
