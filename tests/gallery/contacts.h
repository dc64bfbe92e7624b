#pragma once

#include "gallery/pictures.h"

namespace rex::gallery {

/// The scenes of share/doc/contacts.md.
[[nodiscard]] std::vector<Drawing> contactPictures();

}  // namespace rex::gallery
