#include "base/cpu_lanes.h"

namespace rex {

int cpuLanes() {
#ifdef __x86_64__
  return __builtin_cpu_supports("avx2") ? 4 : 2;
#else
  return 2;
#endif
}

}  // namespace rex
