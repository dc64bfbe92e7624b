#include "cli/run_program.h"

#include <csignal>
#include <cstdio>

#include "base/interruption.h"
#include "cli/command_line.h"

namespace rex::cli {

int runProgram(int argc, const char* const* argv, const Project& project, const Room& room) {
  try {
    const HeldSignals held;
    return runCommandLine(argc, argv, project, room);
  } catch (const Interrupted& stop) {
    // All is cleaned up. Flush the output, then end by the signal, as its sender wants.
    std::fflush(nullptr);
    return std::raise(stop.signal);
  }
}

}  // namespace rex::cli
