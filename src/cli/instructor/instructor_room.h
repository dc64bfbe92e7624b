#pragma once

#include "cli/room.h"

namespace rex::cli {

/// What those do who teach and write exercises: the program `rex-instructor`.
[[nodiscard]] Room instructorRoom();

}  // namespace rex::cli
