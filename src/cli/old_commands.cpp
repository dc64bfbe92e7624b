#include <array>

#include "cli/command_table.h"

namespace rex::cli {

std::span<const OldCommand> oldCommands() {
  static constexpr auto kOld = std::to_array<OldCommand>({
      {"bench", "scripts/rex dev bench"},
      {"care", "scripts/rex linear FILE.json"},
      {"cma", "scripts/rex demo cma --seed S --runs N"},
      {"collect", "scripts/rex grade --collect -o RESULTS"},
      {"curves", "scripts/rex demo curves"},
      {"dare", "scripts/rex linear FILE.json, with \"step\": SECONDS in the file"},
      {"filter", "scripts/rex demo filter --seed S --runs N"},
      {"grade-one", "scripts/rex grade --manifest FILE.tsv --task K -o RESULTS"},
      {"import classroom", "scripts/rex import git CLONES -o HANDED_IN"},
      {"localize", "scripts/rex demo localize --seed S --runs N"},
      {"map", "scripts/rex demo map --seed S --runs N"},
      {"park", "scripts/rex plan SCENE --planner hybrid-astar --goal x,y,heading -o DIR"},
      {"report", "scripts/rex test EXERCISE --report FORMAT, or scripts/rex grade --report=FORMAT"},
      {"search", "scripts/rex demo search --seed S --runs N"},
      {"solution", "scripts/rex show EXERCISE --solution"},
      {"trajectory", "scripts/rex plan SCENE --planner optimize --goal BODY:x,y,z -o DIR"},
      {"walk", "scripts/rex demo walk --seed S --runs N"},
  });
  return kOld;
}

}  // namespace rex::cli
