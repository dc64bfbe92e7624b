#pragma once

#include "cli/room.h"

namespace rex::cli {

/// What a student does with exercises: the program `rex` itself.
[[nodiscard]] Room studentRoom();

}  // namespace rex::cli
