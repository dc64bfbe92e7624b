#pragma once

#include <cstddef>
#include <functional>
#include <string>

namespace rex {

/// What an isolated call may use.
struct IsolationLimits {
  double cpuSeconds = 10;         ///< rounded up to whole seconds
  double wallSeconds = 60;        ///< for one that waits instead of working
  std::size_t memory = 1u << 30;  ///< bytes beyond those of this process; not under sanitizers
};

/// How it ended.
enum class IsolatedEnd { kReturned, kCrashed, kTookTooLong, kOutOfMemory };

struct IsolatedResult {
  IsolatedEnd end = IsolatedEnd::kCrashed;
  int signal = 0;     ///< what ended a crash or a call that took too long, or 0
  int exitCode = -1;  ///< of a function that left the process, or -1
  std::string bytes;  ///< what the function returned, if it did
};

/// Calls a function in a copy of this process, so that nothing it does harms this one: it may crash, loop,
/// exit, leak or fill the memory. Only what it returns comes back; what it prints is lost. An Error that it
/// throws is thrown here, any other exception is a crash. In a process with more threads the function must
/// need no lock that one of them may hold; malloc is safe. Throws Error when no process can be made, and
/// Interrupted as runProcess().
[[nodiscard]] IsolatedResult callIsolated(const std::function<std::string()>& function,
                                          const IsolationLimits& limits = {});

}  // namespace rex
