#include "cli/command_line.h"

int main(int argc, char** argv) {
  return rex::cli::runCommandLine(argc, argv, {REX_PROJECT_ROOT, REX_BUILD_FOLDER});
}
