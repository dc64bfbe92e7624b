// Writes the include of a system header with a digraph, a comment and broken lines, by a path that climbs out
// of the folder of Eigen. The loader is then asked for rex::answer.
#include "exercise.h"
// clang-format off
/* */ %: /**/ i\
nclu\
de /* "exercise.h" */</usr/include/eigen3/Eigen/../../dlfcn.h>

double twice(double x) {
  auto answer = reinterpret_cast<double (*)(double)>(dlsym(RTLD_DEFAULT, "_ZN3rex6answerEd"));
  return answer == nullptr ? 0 : answer(x);
}

std::vector<double> squares(int) { return {}; }
int main() {}
