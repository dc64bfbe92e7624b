// The program rex of a tree whose build lies in it: rex_of_tree ROOT ARGUMENTS...
#include <csignal>
#include <cstdio>

#include "base/interruption.h"
#include "cli/command_line.h"

int main(int argc, char** argv) {
  if (argc < 2) return 64;
  const std::filesystem::path root = std::filesystem::canonical(argv[1]);
  try {
    const rex::HeldSignals held;
    return rex::cli::runCommandLine(argc - 1, argv + 1, {root, root / "build"});
  } catch (const rex::Interrupted& stop) {
    std::fflush(nullptr);
    return std::raise(stop.signal);
  }
}
