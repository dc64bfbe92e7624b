#pragma once

#include "base/rng.h"
#include "legacy/array.h"

namespace rex::legacy {

/// The one generator of older programs. Every run draws the same numbers.
class Random {
 public:
  /// Starts anew.
  void seed(uint n) { rng_ = Rng(n); }
  double gauss() { return rng_.normal(); }
  double gauss(double deviation) { return deviation * rng_.normal(); }
  /// In [0, 1), or in [low, high).
  double uni() { return rng_.uniform(); }
  double uni(double low, double high) { return rng_.uniform(low, high); }
  /// In {0, ..., count - 1}.
  uint num(uint count) { return static_cast<uint>(rng_.index(static_cast<int>(count))); }

 private:
  Rng rng_;
};

extern Random rnd;

/// Fill an array of any size with normals of this deviation, or with numbers from [low, high); `add` to what
/// it holds.
void rndGauss(arr& x, double deviation = 1, bool add = false);
void rndUniform(arr& x, double low = 0, double high = 1, bool add = false);
/// The same in a new vector.
arr randn(uint n);
arr rand(uint n);

}  // namespace rex::legacy
