#include "base/error.h"
#include "cli/command_table.h"
#include "formats/assets.h"
#include "formats/scene_file.h"

namespace rex::cli {
namespace {

// The first word after the command that is a scene names the file.
std::vector<std::string> posturesFor(const Project& project, std::span<const std::string> words) {
  std::vector<std::string> names = {"0", "file"};
  for (const std::string& word : words.subspan(1)) {
    try {
      const auto file = findScene(word, project.files() / "data");
      for (const PostureSpec& one : readScene(file, {.allowMissingMeshes = true}).spec.postures)
        names.push_back(one.name);
      break;
    } catch (const Error&) {
      continue;
    }
  }
  return names;
}

}  // namespace

CommandSet robotCommands() {
  return {.program = Program::kRobot,
          .commands = {{"doctor", addDoctor},
                       {"linear", addLinear},
                       {"plan", addPlan},
                       {"render", addRender},
                       {"scene", addScene},
                       {"simulate", addSimulate},
                       {"slam", addSlam},
                       {"view", addView}},
          .postures = posturesFor};
}

}  // namespace rex::cli
