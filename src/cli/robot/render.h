#pragma once

#include "base/exit_code.h"
#include "cli/robot/render_plan.h"

namespace rex::cli {

/// Makes what the options request. Throws like planOf(), loadScene() and the functions that write files.
ExitCode render(const Project& project, const RenderOptions& options);

}  // namespace rex::cli
