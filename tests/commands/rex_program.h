#pragma once

#include "cli/rex_command.h"
#include "support/paths.h"

namespace rex::cli {

/// The same by the programs that were built, for other environments and as processes that end; without the
/// way through `rex`, which builds.
class RexProgram : public RexCommand {
 protected:
  ProcessResult rex(const std::vector<std::string>& arguments) const override {
    std::vector<std::string> command = {buildPath(programName(programOf(arguments.at(0))))};
    command.insert(command.end(), arguments.begin(), arguments.end());
    return runProcess(command, {.directory = folder(), .timeout = 300});
  }
};

}  // namespace rex::cli
