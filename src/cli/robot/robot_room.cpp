#include "cli/command_table.h"

namespace rex::cli {

Room robotRoom() {
  return {.program = Program::kRobot,
          .commands = {{"doctor", addDoctor},
                       {"linear", addLinear},
                       {"plan", addPlan},
                       {"render", addRender},
                       {"scene", addScene},
                       {"simulate", addSimulate},
                       {"slam", addSlam},
                       {"view", addView}}};
}

}  // namespace rex::cli
