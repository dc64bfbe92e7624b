#pragma once

#include "cli/room.h"

namespace rex::cli {

/// One file each; see Registration.
void addLinear(CLI::App* command, Action& action);
void addSlam(CLI::App* command, Action& action);

}  // namespace rex::cli
