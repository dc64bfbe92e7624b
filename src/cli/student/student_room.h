#pragma once

#include "cli/room.h"

namespace rex::cli {

/// The student's commands for exercises: the program `rex` itself.
[[nodiscard]] Room studentRoom();

}  // namespace rex::cli
