#pragma once

#include "cli/room.h"

namespace rex::cli {

/// One file each; see Registration.
void addDebug(CLI::App* command, Action& action);
void addDemo(CLI::App* command, Action& action);
void addHint(CLI::App* command, Action& action);
void addInit(CLI::App* command, Action& action);
void addList(CLI::App* command, Action& action);
void addReset(CLI::App* command, Action& action);
void addRun(CLI::App* command, Action& action);
void addShow(CLI::App* command, Action& action);
void addSubmit(CLI::App* command, Action& action);
void addTest(CLI::App* command, Action& action);
void addUpdate(CLI::App* command, Action& action);
void addWatch(CLI::App* command, Action& action);

}  // namespace rex::cli
