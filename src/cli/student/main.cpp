#include "cli/run_program.h"
#include "cli/student/student_room.h"

int main(int argc, char** argv) {
  return rex::cli::runProgram(argc, argv, rex::cli::findProject(), rex::cli::studentRoom());
}
