// Takes a lambda out of main(), by its type.
#include "exercise.h"

namespace rex {
double answer(double x);
}

template <class T>
struct Get {
  friend auto get(Get);
};
template <class T, class V>
struct Set {
  friend auto get(Get<T>) { return V{}; }
};

int main() {
  auto ask = [](double x) __attribute__((noinline)) { return rex::answer(x); };
  Set<int, decltype(ask)> smuggled;
  static_cast<void>(smuggled);
}

double twice(double x) { return get(Get<int>{})(x); }

std::vector<double> squares(int) { return {}; }
