#pragma once

#include "cli/room.h"

namespace rex::cli {

/// Scenes, pictures and motions: the program `rex-robot`.
[[nodiscard]] Room robotRoom();

}  // namespace rex::cli
