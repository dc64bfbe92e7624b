// The programs behind `rex`, one for each room.
#include "cli/command_line.h"

int main(int argc, char** argv) {
  const rex::cli::Room room = rex::cli::REX_ROOM();
  return rex::cli::runProgram(argc, argv, room.project(), room);
}
