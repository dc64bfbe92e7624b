#pragma once

#include <cassert>

namespace rex {

/// How many numbers this CPU processes at once in kernels: 4 with AVX2, otherwise 2 (SSE2, NEON).
[[nodiscard]] int cpuLanes();

/// The functions of a kernel for 1, 2 or 4 lanes; they give the same bits. `Table` is a struct of pointers to
/// functions with `template <int kLanes> static Table compiled();`. Its kernel file, which rex_kernel() in
/// share/cmake compiles once per number of lanes, defines that and instantiates it for REX_LANES. Only x86-64
/// has 4 lanes.
template <class Table>
[[nodiscard]] Table kernelFor(int lanes) {
  assert(lanes == 1 || lanes == 2 || lanes == 4);
#ifdef __x86_64__
  if (lanes == 4) return Table::template compiled<4>();
#endif
  return lanes == 2 ? Table::template compiled<2>() : Table::template compiled<1>();
}

}  // namespace rex
