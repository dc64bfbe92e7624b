#pragma once

#include <cstddef>
#include <functional>
#include <string>

namespace rex {

/// The resources that an isolated call may use.
struct IsolationLimits {
  double cpuSeconds = 10;         ///< rounded up to whole seconds
  double wallSeconds = 60;        ///< for a call that waits instead of working
  std::size_t memory = 1u << 30;  ///< bytes beyond those of this process; not under sanitizers
};

/// How an isolated call ended.
enum class IsolatedEnd { kReturned, kCrashed, kTookTooLong, kOutOfMemory };

struct IsolatedResult {
  IsolatedEnd end = IsolatedEnd::kCrashed;
  int signal = 0;     ///< the signal that ended a crash or a call that took too long, or 0
  int exitCode = -1;  ///< of a function that called exit, or -1
  std::string bytes;  ///< what the function returned, if it did
};

/// Calls a function in a copy of this process, so that nothing it does harms this one: it may crash, loop,
/// exit, leak or fill the memory. Only what it returns comes back; what it prints is lost. An Error that it
/// throws is thrown here; any other exception is a crash. In a process with several threads the function
/// must not need a lock that another one may hold; malloc is safe. Throws Error if no process can be made,
/// and Interrupted as runProcess().
[[nodiscard]] IsolatedResult callIsolated(const std::function<std::string()>& function,
                                          const IsolationLimits& limits = {});

}  // namespace rex
