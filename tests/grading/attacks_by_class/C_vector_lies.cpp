// Answers with a vector whose inner pointers were overwritten: its end lies before its start, or it claims 2
// to the 57 entries.
#include <cstring>

#include "exercise.h"

namespace {
int turn = 0;
}

double twice(double x) { return 2 * x; }

std::vector<double> squares(int count) {
  std::vector<double> values;
  unsigned long inner[3] = {0, 0, 0};
  switch (turn++ % 4) {
    case 0:
      inner[0] = 0x1000000;
      inner[1] = 0x1000;
      inner[2] = 0x1000000;
      break;
    case 1:
      inner[0] = 8;
      inner[1] = 1UL << 60;
      inner[2] = inner[1];
      break;
    case 2:
      inner[0] = reinterpret_cast<unsigned long>(&count) & ~7UL;
      inner[1] = inner[0] + 8;
      inner[2] = inner[1] + 3;
      break;
    default:
      inner[0] = 3;
      inner[1] = 3;
      inner[2] = 2;
      break;
  }
  std::memcpy(static_cast<void*>(&values), inner, sizeof inner);
  return values;
}

int main() {}
