#pragma once

#include "cli/room.h"

namespace rex::cli {

/// One file each; see Registration.
void addCare(CLI::App* command, Action& action);
void addCma(CLI::App* command, Action& action);
void addCurves(CLI::App* command, Action& action);
void addDare(CLI::App* command, Action& action);
void addFilter(CLI::App* command, Action& action);
void addLinear(CLI::App* command, Action& action);
void addLocalize(CLI::App* command, Action& action);
void addMap(CLI::App* command, Action& action);
void addSearch(CLI::App* command, Action& action);
void addSlam(CLI::App* command, Action& action);
void addWalk(CLI::App* command, Action& action);

}  // namespace rex::cli
