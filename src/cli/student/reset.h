#pragma once

#include <string>

#include "base/exit_code.h"
#include "cli/project.h"

namespace rex::cli {

/// Restores main.cpp as it was handed out, and keeps a copy of the current one.
ExitCode reset(const Project& project, const std::string& name);

}  // namespace rex::cli
