#pragma once

#include "cli/room.h"

namespace rex::cli {

/// One file each; see Registration.
void addDev(CLI::App* command, Action& action);
void addExport(CLI::App* command, Action& action);
void addGrade(CLI::App* command, Action& action);
void addImport(CLI::App* command, Action& action);

}  // namespace rex::cli
