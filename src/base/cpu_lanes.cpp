#include "base/cpu_lanes.h"

namespace rex {

int cpuLanes() { return __builtin_cpu_supports("avx2") ? 4 : 2; }

}  // namespace rex
