#include "cli/robot/robot_room.h"

#include "cli/robot/robot_room_internal.h"

namespace rex::cli {

Room robotRoom() {
  return {.program = Program::kRobot,
          .commands = {{"doctor", addDoctor},
                       {"plan", addPlan},
                       {"render", addRender},
                       {"scene", addScene},
                       {"simulate", addSimulate},
                       {"view", addView}}};
}

}  // namespace rex::cli
