#include "base/process_pool.h"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <map>
#include <thread>

#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/error.h"
#include "base/interruption.h"

namespace rex {
namespace {

constexpr auto kPause = std::chrono::milliseconds(2);

[[noreturn]] void work(const std::function<int(int)>& job, int k, pid_t parent, int cpuSeconds) {
  constexpr int kBroken = 3;
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(kBroken);
  ::setpgid(0, 0);  // Ctrl-C reaches us, and we pass it on
  rlimit time{};
  if (cpuSeconds > 0 && ::getrlimit(RLIMIT_CPU, &time) == 0) {
    time.rlim_cur = std::min(time.rlim_max, static_cast<rlim_t>(cpuSeconds));
    ::setrlimit(RLIMIT_CPU, &time);
  }
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
    const pid_t parent = ::getpid(), copy = ::fork();
    if (copy < 0) throw Error({.what = "cannot start a process", .found = std::strerror(errno)});
    if (copy == 0) work(job, k, parent, cpuSeconds);
    ::setpgid(copy, copy);
    running_[copy] = k;
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
      int status = 0;
      ::waitpid(copy, &status, 0);
      entry = running_.erase(entry);
      ended(k, WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status));
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
      ::waitpid(copy, nullptr, 0);
    }
    running_.clear();
  }

 private:
  std::map<pid_t, int> running_;
};

}  // namespace

void runInCopies(int count, int parallel, const std::function<int(int)>& job,
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
