#include "cli/instructor/instructor_room.h"
#include "cli/run_program.h"

int main(int argc, char** argv) {
  return rex::cli::runProgram(argc, argv, rex::cli::findProjectOfInstructor(), rex::cli::instructorRoom());
}
