#include "cli/methods/methods_room.h"

#include "cli/methods/methods_room_internal.h"

namespace rex::cli {

Room methodsRoom() {
  return {.program = Program::kMethods,
          .commands = {{"care", addCare},
                       {"cma", addCma},
                       {"curves", addCurves},
                       {"dare", addDare},
                       {"filter", addFilter},
                       {"linear", addLinear},
                       {"localize", addLocalize},
                       {"map", addMap},
                       {"search", addSearch},
                       {"slam", addSlam},
                       {"walk", addWalk}}};
}

}  // namespace rex::cli
