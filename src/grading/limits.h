#pragma once

#include <cmath>
#include <cstddef>

namespace rex::grading {

inline constexpr std::size_t kMegabyte = std::size_t{1} << 20;

/// By how much more processor time a program with the sanitizers may use.
inline constexpr double kSanitizedSlowness = 20;

/// What a student's functions may use in one check. Sizes are in bytes.
struct Limits {
  double cpuSeconds = 10;  ///< of all threads; rounded up to whole seconds by the kernel
  /// How long the grader waits for them in total, once their worker is ready; 0: 2 x CPU + 2. On a busy
  /// machine a second attempt gets more: see slownessOfMachine().
  double wallSeconds = 0;
  std::size_t memory = 1024 * kMegabyte;  ///< of address space; not enforced in sanitizer builds
  std::size_t output = 16 * kMegabyte;    ///< printed, standard output and error together
  bool sanitized = false;  ///< the program reserves terabytes and enforces its memory limit itself

  [[nodiscard]] double cpuBudget() const { return std::ceil(cpuSeconds); }
  [[nodiscard]] double wallBudget() const { return wallSeconds > 0 ? wallSeconds : 2 * cpuSeconds + 2; }
  /// How long the grader waits until a worker is ready, before the time of wallBudget() begins.
  [[nodiscard]] double startBudget() const { return wallBudget() + 2; }
};

}  // namespace rex::grading
