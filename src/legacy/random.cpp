#include "legacy/random.h"

namespace rex::legacy {
namespace {

template <class Draw>
void fill(arr& x, bool add, const Draw& draw) {
  const bool isMatrix = x.nd == 2;
  const uint columns = isMatrix ? x.d1 : 1;
  for (uint i = 0; i < x.d0; ++i)
    for (uint j = 0; j < columns; ++j) {
      double& number = isMatrix ? x(i, j) : x(i);
      number = draw() + (add ? number : 0);
    }
}

}  // namespace

Random rnd;

void rndGauss(arr& x, double deviation, bool add) {
  fill(x, add, [deviation] { return rnd.gauss(deviation); });
}

void rndUniform(arr& x, double low, double high, bool add) {
  fill(x, add, [low, high] { return rnd.uni(low, high); });
}

arr randn(uint n) {
  arr x(n);
  rndGauss(x);
  return x;
}

arr rand(uint n) {
  arr x(n);
  rndUniform(x);
  return x;
}

}  // namespace rex::legacy
