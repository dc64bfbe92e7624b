#include "cli/command_table.h"
#include "cli/student/progress.h"

namespace rex::cli {

CommandSet studentCommands() {
  return {.program = Program::kStudent,
          .commands = {{"debug", addDebug},
                       {"demo", addDemo},
                       {"hint", addHint},
                       {"init", addInit},
                       {"list", addList},
                       {"reset", addReset},
                       {"run", addRun},
                       {"show", addShow},
                       {"submit", addSubmit},
                       {"test", addTest},
                       {"update", addUpdate},
                       {"watch", addWatch}},
          .withoutCommand = progress};
}

}  // namespace rex::cli
