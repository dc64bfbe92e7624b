#include "cli/instructor/instructor_room.h"

#include "cli/instructor/instructor_room_internal.h"

namespace rex::cli {

Room instructorRoom() {
  return {.program = Program::kInstructor,
          .commands = {{"bench", addBench},
                       {"collect", addCollect},
                       {"dev", addDev},
                       {"export", addExport},
                       {"grade", addGrade},
                       {"grade-one", addGradeOne},
                       {"import", addImport}}};
}

}  // namespace rex::cli
