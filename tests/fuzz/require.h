#pragma once

#include <cstdio>
#include <cstdlib>

namespace rex::fuzz {

/// Ends the process, which is how a fuzz target reports that `property` does not hold for its input.
inline void require(bool holds, const char* property) {
  if (holds) return;
  std::fprintf(stderr, "property broken: %s\n", property);
  std::abort();
}

}  // namespace rex::fuzz
