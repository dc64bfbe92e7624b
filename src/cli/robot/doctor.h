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
  std::optional<sandbox::Level> level{};  ///< of the sandbox, that must hold; nothing: the best
};
/// Attacks the sandbox from inside with a program of ours. kWeakSandbox unless the asked level holds.
ExitCode doctorOfSandbox(const Project& project, const DoctorOptions& options);

}  // namespace rex::cli
