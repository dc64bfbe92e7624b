#include "base/error.h"
#include "cli/commands.h"
#include "cli/terminal.h"

namespace rex::cli {

ExitCode sceneConvert(const Project&, const ConvertOptions&) { throw UsageError({.what = "convert"}); }

}  // namespace rex::cli
