// The programs behind `rex`, one for each set of commands.
#include "cli/command_line.h"

int main(int argc, char** argv) {
  const rex::cli::CommandSet set = rex::cli::REX_COMMANDS();
  return rex::cli::runProgram(argc, argv, set.project(), set);
}
