#include "cli/robot/robot_room.h"
#include "cli/run_program.h"

int main(int argc, char** argv) {
  return rex::cli::runProgram(argc, argv, {REX_PROJECT_ROOT, REX_BUILD_FOLDER}, rex::cli::robotRoom());
}
