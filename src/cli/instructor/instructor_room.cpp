#include "cli/instructor/instructor_room.h"

#include "cli/instructor/instructor_room_internal.h"

namespace rex::cli {

Room instructorRoom() {
  return {.program = Program::kInstructor,
          .commands = {{"dev", addDev}, {"export", addExport}, {"grade", addGrade}, {"import", addImport}}};
}

}  // namespace rex::cli
