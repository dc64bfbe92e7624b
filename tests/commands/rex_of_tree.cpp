// The program rex of a tree whose build lies in it: rex_of_tree ROOT ARGUMENTS...
#include "cli/command_line.h"
#include "commands/all_commands.h"

int main(int argc, char** argv) {
  if (argc < 2) return 64;
  const std::filesystem::path root = std::filesystem::canonical(argv[1]);
  const rex::cli::Program program = rex::cli::programOf(argc > 2 ? argv[2] : "");
  return rex::cli::runProgram(argc - 1, argv + 1, {root, root / "build"}, rex::cli::anyCommands(program));
}
