#pragma once

#include <string>

#include "base/process.h"
#include "support/paths.h"
#include "support/report_checker.h"

namespace rex::cli {

/// What an output of a command with --json has otherwise than that definition of
/// share/grading/commands.schema.json; empty: nothing.
inline std::string schemaFaultsOf(const std::string& output, const std::string& definition) {
  const ProcessResult run = runProcess({kPython, sourcePath("tests/cli/check_json.py"),
                                        sourcePath("share/grading/commands.schema.json"), definition},
                                       {.input = output});
  return run.ok() ? run.output : run.output + run.error;
}

}  // namespace rex::cli
