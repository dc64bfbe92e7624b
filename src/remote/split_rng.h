#pragma once

#include <cstdint>

#include "base/rng.h"

namespace rex::remote {

template <class T>
struct Wire;

/// A generator that may cross to a worker; no other may. Its first state is a SHA-256 hash, so nobody who
/// runs it backwards finds the generator that it was split from, nor the seed of a case.
class SplitRng : public Rng {
 public:
  /// The same (state of `from`, label) gives the same generator.
  SplitRng(const Rng& from, std::uint64_t label);
  SplitRng(const Rng&) = delete;  // a generator of the grader gives its seed when run backwards: split it

 private:
  friend struct Wire<SplitRng>;
  struct Received {};
  SplitRng(Received, const Rng& rng) : Rng(rng) {}
};

}  // namespace rex::remote
