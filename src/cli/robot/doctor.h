#pragma once

#include <optional>
#include <string>

#include "base/exit_code.h"
#include "cli/project.h"
#include "sandbox/level.h"

namespace rex::cli {

struct DoctorOptions {
  std::string gl;  ///< auto, osmesa or egl; empty: auto
  bool json = false;
  bool sandbox = false;                   ///< attack the sandbox instead
  std::optional<sandbox::Level> level{};  ///< the sandbox level to test; empty: the best
};
/// Attacks the sandbox from inside with our own program. Returns kWeakSandbox unless the requested level
/// holds.
ExitCode doctorOfSandbox(const Project& project, const DoctorOptions& options);

}  // namespace rex::cli
