#include "base/process_pool.h"

#include <chrono>
#include <csignal>
#include <cstdio>
#include <map>
#include <thread>

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/child.h"
#include "base/interruption.h"

namespace rex {
namespace {

constexpr auto kPause = std::chrono::milliseconds(2);

[[noreturn]] void work(const std::function<int(int)>& job, int k, int cpuSeconds) {
  constexpr int kBroken = 3;
  if (cpuSeconds > 0) lowerLimit(RLIMIT_CPU, static_cast<rlim_t>(cpuSeconds), RLIM_INFINITY);
  int code = kBroken;
  try {
    code = job(k);
  } catch (const Interrupted& stop) {
    code = 128 + stop.signal;
  } catch (...) {
  }
  ::_exit(code);
}

/// The copies that are running.
class Copies {
 public:
  Copies() = default;
  ~Copies() { end(SIGKILL); }
  Copies(const Copies&) = delete;
  Copies& operator=(const Copies&) = delete;

  int count() const { return static_cast<int>(running_.size()); }

  void start(const std::function<int(int)>& job, int k, int cpuSeconds) {
    std::fflush(nullptr);  // or the copy would inherit our unwritten output
    // In a group of its own: Ctrl-C reaches us, and we pass it on.
    running_[forkChild("a process", [&] { work(job, k, cpuSeconds); })] = k;
  }

  // Removes the copies that have ended and calls `ended` for each.
  void reap(const std::function<void(int, int)>& ended) {
    for (auto entry = running_.begin(); entry != running_.end();) {
      const auto [copy, k] = *entry;
      siginfo_t end{};
      ::waitid(P_PID, static_cast<id_t>(copy), &end, WEXITED | WNOHANG | WNOWAIT);
      if (end.si_pid != copy) {
        ++entry;
        continue;
      }
      // If a copy was killed, so is what it started. Its ID is not reused until we wait for it.
      if (end.si_code != CLD_EXITED) ::kill(-copy, SIGKILL);
      const ChildEnd how = *waitForChild(copy);
      entry = running_.erase(entry);
      ended(k, how.signal() != 0 ? -how.signal() : how.exitCode());
    }
  }

  // Passes the signal on and kills every copy that has not ended after a few seconds.
  void end(int signal) {
    constexpr int kPatience = 2500;
    for (const auto& [copy, k] : running_) ::kill(-copy, signal);
    for (int waited = 0; waited < kPatience && !running_.empty(); ++waited) {
      reap([](int, int) {});
      if (!running_.empty()) std::this_thread::sleep_for(kPause);
    }
    for (const auto& [copy, k] : running_) {
      ::kill(-copy, SIGKILL);
      waitForChild(copy);
    }
    running_.clear();
  }

 private:
  std::map<pid_t, int> running_;
};

}  // namespace

void forkMap(int count, int parallel, const std::function<int(int)>& job,
             const std::function<void(int, int)>& ended, int cpuSeconds) {
  Copies copies;
  try {
    for (int next = 0; next < count || copies.count() > 0;) {
      throwIfInterrupted();
      if (next < count && copies.count() < parallel) {
        copies.start(job, next++, cpuSeconds);
        continue;
      }
      std::this_thread::sleep_for(kPause);
      copies.reap(ended);
    }
  } catch (const Interrupted& stop) {
    copies.end(stop.signal);
    throw;
  }
}

}  // namespace rex
