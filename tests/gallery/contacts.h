#pragma once

#include "gallery/pictures.h"

namespace rex::gallery {

/// The scenes of tests/contact.
[[nodiscard]] std::vector<Drawing> contactPictures();

}  // namespace rex::gallery
