// Instantiates templates without end.
#include "exercise.h"

template <int N, int M>
struct F {
  enum { v = F<N - 1, M>::v + F<N - 1, M + 1>::v };
};
template <int M>
struct F<0, M> {
  enum { v = 1 };
};

double twice(double) { return F<150, 0>::v; }
std::vector<double> squares(int) { return {}; }
int main() {}
