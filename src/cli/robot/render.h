#pragma once

#include "base/exit_code.h"
#include "cli/robot/render_plan.h"

namespace rex::cli {

/// Makes what the options ask for. Throws as planOf(), loadScene() and those who write.
ExitCode render(const Project& project, const RenderOptions& options);

}  // namespace rex::cli
