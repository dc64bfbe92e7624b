#pragma once

#include "cli/room.h"

namespace rex::cli {

/// One file each; see Registration.
void addDoctor(CLI::App* command, Action& action);
void addPlan(CLI::App* command, Action& action);
void addRender(CLI::App* command, Action& action);
void addScene(CLI::App* command, Action& action);
void addSimulate(CLI::App* command, Action& action);
void addView(CLI::App* command, Action& action);

}  // namespace rex::cli
