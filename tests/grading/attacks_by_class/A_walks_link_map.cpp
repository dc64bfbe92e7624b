// Follows DT_DEBUG of its own dynamic section to the list of loaded files and looks up rex::answer in their
// tables. No forbidden symbol is named in the object; only _DYNAMIC is.
#include "attack_tools.h"

extern "C" __attribute__((visibility("hidden"))) Dyn _DYNAMIC[];

double twice(double x) {
  for (Dyn* entry = _DYNAMIC; entry->tag != 0; ++entry) {
    if (entry->tag != 21 || entry->value == 0) continue;
    for (Map* map = *reinterpret_cast<Map**>(entry->value + 8); map != nullptr; map = map->next) {
      if (Answer answer = in_tables(map->base, map->dynamic)) return answer(x);
    }
  }
  return 0;
}

std::vector<double> squares(int) { return {}; }
int main() {}
