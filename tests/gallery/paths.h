#pragma once

#include "gallery/pictures.h"

namespace rex::gallery {

/// What `rex plan` explores and finds, in the order of the page.
[[nodiscard]] std::vector<Drawing> pathPictures();

}  // namespace rex::gallery
