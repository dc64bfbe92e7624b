#include "cli/command_table.h"

namespace rex::cli {

CommandSet instructorCommands() {
  return {.program = Program::kInstructor,
          .commands = {{"dev", addDev}, {"export", addExport}, {"grade", addGrade}, {"import", addImport}},
          .project = findProjectOfInstructor};
}

}  // namespace rex::cli
