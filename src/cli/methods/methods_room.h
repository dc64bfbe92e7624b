#pragma once

#include "cli/room.h"

namespace rex::cli {

/// Methods of the course on problems that come with them: the program `rex-methods`.
[[nodiscard]] Room methodsRoom();

}  // namespace rex::cli
