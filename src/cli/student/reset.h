#pragma once

#include <string>

#include "base/exit_code.h"
#include "cli/project.h"

namespace rex::cli {

/// Makes main.cpp as it was handed out, and keeps the one that is there.
ExitCode reset(const Project& project, const std::string& name);

}  // namespace rex::cli
