#pragma once

#include <cmath>

namespace rex::grading {

/// What one worker process may use.
struct WorkerLimits {
  double cpuSeconds = 10;  ///< of all its threads; rounded up to whole seconds by the kernel
  /// That the grader waits for it in total, 0: 2 x CPU + 2. What others on a busy machine take is added.
  double wallSeconds = 0;
  int memoryMegabytes = 2048;  ///< of address space; not enforced in sanitizer builds
  bool sanitized = false;      ///< the program reserves terabytes and keeps its limit of memory by itself
  int outputMegabytes = 8;     ///< printed, standard output and error together

  double cpuBudget() const { return std::ceil(cpuSeconds); }
  double wallBudget() const { return wallSeconds > 0 ? wallSeconds : 2 * cpuSeconds + 2; }
};

}  // namespace rex::grading
