#pragma once

#include "cli/room.h"

namespace rex::cli {

/// The commands for teaching and writing exercises: the program `rex-instructor`.
[[nodiscard]] Room instructorRoom();

}  // namespace rex::cli
