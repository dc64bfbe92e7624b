#include "cli/methods/methods_room.h"

#include "cli/methods/methods_room_internal.h"

namespace rex::cli {

Room methodsRoom() {
  return {.program = Program::kMethods, .commands = {{"linear", addLinear}, {"slam", addSlam}}};
}

}  // namespace rex::cli
