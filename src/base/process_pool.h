#pragma once

#include <functional>

namespace rex {

/// Calls job(k) for k = 0 .. count-1, each in a copy of this process, at most `parallel` at a time, started
/// in this order. After each, `ended(k, code)` is called here with the code that the job returned, or minus
/// the signal that killed its process. Copies end when this process dies. If `cpuSeconds` is not 0, the
/// kernel ends a copy that itself has used more processor time (SIGXCPU); programs that it starts count for
/// themselves. Throws Interrupted after all copies have cleaned up, and Error if no process can be made.
void forkMap(int count, int parallel, const std::function<int(int)>& job,
             const std::function<void(int, int)>& ended, int cpuSeconds = 0);

}  // namespace rex
