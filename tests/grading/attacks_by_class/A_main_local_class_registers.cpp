// A class inside main() calls rex::answer. A variable made from a template with that class is initialised
// when the program is loaded, and keeps a pointer to the function for twice().
#include "exercise.h"

namespace rex {
double answer(double x);
}

double (*hook)(double);

template <class T>
bool registered = (hook = &T::ask, true);

int main() {
  struct Local {
    static double ask(double x) { return rex::answer(x); }
  };
  return registered<Local> ? 0 : 1;
}

double twice(double x) { return hook == nullptr ? 0 : hook(x); }

std::vector<double> squares(int) { return {}; }
