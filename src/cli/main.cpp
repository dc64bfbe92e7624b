#include <csignal>
#include <cstdio>

#include "base/interruption.h"
#include "cli/command_line.h"

int main(int argc, char** argv) {
  try {
    const rex::HeldSignals held;
    return rex::cli::runCommandLine(argc, argv, {REX_PROJECT_ROOT, REX_BUILD_FOLDER});
  } catch (const rex::Interrupted& stop) {
    // Everything is tidied up: now end as the sender of the signal wants, but lose no text.
    std::fflush(nullptr);
    return std::raise(stop.signal);
  }
}
