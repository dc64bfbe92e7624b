#pragma once

#include <string>

#include "base/process.h"
#include "support/report_checker.h"

namespace rex::cli {

/// What an output of a command with --json has otherwise than that definition of
/// share/grading/commands.schema.json; empty: nothing.
inline std::string schemaFaultsOf(const std::string& output, const std::string& definition) {
  const ProcessResult run = runProcess({kPython, REX_SOURCE_DIR "/tests/cli/check_json.py",
                                        REX_SOURCE_DIR "/share/grading/commands.schema.json", definition},
                                       {.input = output});
  return run.ok() ? run.output : run.output + run.error;
}

}  // namespace rex::cli
