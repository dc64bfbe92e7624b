#pragma once

#include <functional>

namespace rex {

/// Calls job(k) for k = 0 .. count-1, each in a copy of this process, at most `parallel` at a time, begun in
/// this order. After each, `ended(k, code)` is called here: the code that the job returned, or minus the
/// signal that killed its process. A copy that works when this process dies ends with it. Throws Interrupted
/// when all copies have tidied up, and Error when no process can be made.
void runInCopies(int count, int parallel, const std::function<int(int)>& job,
                 const std::function<void(int, int)>& ended);

}  // namespace rex
