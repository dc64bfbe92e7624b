#include "base/isolated_call.h"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <new>
#include <string_view>

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/error.h"
#include "base/interruption.h"
#include "base/pipe.h"
#include "base/stop_requests_internal.h"
#include "base/text.h"

// GCC first: libraries define a __has_feature for it that knows of nothing.
#if defined(__SANITIZE_ADDRESS__)
#define REX_ADDRESS_SANITIZER
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
#define REX_ADDRESS_SANITIZER
#endif
#endif

namespace rex {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int kOutOfMemoryCode = 113;  // exit code of a child that runs out of memory

// The child sends this, followed by the bytes.
struct Head {
  enum Kind : std::uint64_t { kValue, kError };
  Kind kind = kValue;
  std::uint64_t size = 0;
};

void addText(std::string& bytes, std::string_view text) {
  const std::uint64_t size = text.size();
  bytes.append(reinterpret_cast<const char*>(&size), sizeof size).append(text);
}

std::string packed(const ErrorParts& parts) {
  std::string bytes;
  for (const std::string* text : {&parts.what, &parts.where.file, &parts.found, &parts.wanted})
    addText(bytes, *text);
  addText(bytes, std::to_string(parts.where.line));
  addText(bytes, std::to_string(parts.where.column));
  for (const std::string& name : parts.nearest) addText(bytes, name);
  return bytes;
}

std::string takeText(std::string_view& bytes) {
  std::uint64_t size = 0;
  if (bytes.size() < sizeof size) return {};
  std::memcpy(&size, bytes.data(), sizeof size);
  bytes.remove_prefix(sizeof size);
  const std::string text(bytes.substr(0, size));
  bytes.remove_prefix(text.size());
  return text;
}

ErrorParts unpacked(std::string_view bytes) {
  ErrorParts parts;
  for (std::string* text : {&parts.what, &parts.where.file, &parts.found, &parts.wanted})
    *text = takeText(bytes);
  parts.where.line = parseNumber<int>(takeText(bytes)).value_or(0);
  parts.where.column = parseNumber<int>(takeText(bytes)).value_or(0);
  while (!bytes.empty()) parts.nearest.push_back(takeText(bytes));
  return parts;
}

void lower(int resource, rlim_t soft, rlim_t hard) {
  rlimit present{};
  const auto which = static_cast<__rlimit_resource>(resource);
  ::getrlimit(which, &present);
  const rlimit wanted{std::min(soft, present.rlim_max), std::min(hard, present.rlim_max)};
  ::setrlimit(which, &wanted);
}

// The size of this process's address space in bytes.
rlim_t presentSize() {
  char text[64] = {};
  const int fd = ::open("/proc/self/statm", O_RDONLY | O_CLOEXEC);
  const ssize_t n = ::read(fd, text, sizeof text - 1);
  ::close(fd);
  std::string_view pages(text, static_cast<std::size_t>(std::max<ssize_t>(n, 0)));
  return takeNumber<rlim_t>(pages).value_or(0) * static_cast<rlim_t>(::sysconf(_SC_PAGESIZE));
}

// The sanitizers reserve the whole address space at once.
#ifdef REX_ADDRESS_SANITIZER
constexpr bool kLimitsMemory = false;
#else
constexpr bool kLimitsMemory = true;
#endif

void applyLimits(const IsolationLimits& limits) {
  const auto seconds = static_cast<rlim_t>(std::ceil(limits.cpuSeconds));
  lower(RLIMIT_CPU, seconds, seconds + 1);
  lower(RLIMIT_CORE, 0, 0);
  if (!kLimitsMemory) return;
  const rlim_t memory = presentSize() + limits.memory;
  lower(RLIMIT_AS, memory, memory);
}

void writeAll(int fd, const void* data, std::size_t size) {
  for (const char* at = static_cast<const char*>(data); size > 0;) {
    const ssize_t n = ::write(fd, at, size);
    if (n < 0 && errno != EINTR) ::_exit(1);
    if (n > 0) at += n, size -= static_cast<std::size_t>(n);
  }
}

void send(int fd, Head::Kind kind, std::string_view bytes) {
  const Head head{kind, bytes.size()};
  writeAll(fd, &head, sizeof head);
  writeAll(fd, bytes.data(), bytes.size());
}

// The parent's handlers would do its work twice. Stop requests that the parent holds back stay blocked.
void resetSignals(const sigset_t& held) {
  for (int signal = 1; signal < NSIG; ++signal) {
    struct sigaction action {};
    if (::sigaction(signal, nullptr, &action) == 0 && action.sa_handler != SIG_IGN) ::signal(signal, SIG_DFL);
  }
  const sigset_t stop = stopSignals();
  sigset_t blocked;
  ::sigandset(&blocked, &stop, &held);
  ::sigprocmask(SIG_SETMASK, &blocked, nullptr);
}

// Runs in the child. An exception other than Error ends it, as none of the parent's code may run twice.
[[noreturn]] void answer(const std::function<std::string()>& function, const IsolationLimits& limits,
                         int result, pid_t parent, const sigset_t& held) noexcept {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(1);
  resetSignals(held);
  const int nowhere = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
  ::dup2(nowhere, STDOUT_FILENO);
  ::dup2(nowhere, STDERR_FILENO);
  std::set_new_handler([] { ::_exit(kOutOfMemoryCode); });
  applyLimits(limits);
  try {
    send(result, Head::kValue, function());
  } catch (const Error& error) {
    send(result, Head::kError, packed(error.parts()));
  }
  ::_exit(0);
}

// The process that answers; it does not outlive this object.
class Child {
 public:
  Child(const std::function<std::string()>& function, const IsolationLimits& limits, Pipe& pipe) {
    sigset_t all, held;
    ::sigfillset(&all);
    ::pthread_sigmask(SIG_BLOCK, &all, &held);
    const pid_t parent = ::getpid();
    id_ = ::fork();
    const int cause = errno;
    if (id_ == 0) answer(function, limits, pipe.writeEnd(), parent, held);
    ::pthread_sigmask(SIG_SETMASK, &held, nullptr);
    if (id_ < 0) throw Error({.what = "cannot start a process", .found = std::strerror(cause)});
    pipe.closeWrite();
  }
  ~Child() {
    if (!ended_) end();
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  /// Kills it, unless it has ended, and returns its status.
  int end() {
    ::kill(id_, SIGKILL);
    return wait();
  }
  int wait() {
    int status = 0;
    while (::wait4(id_, &status, 0, &usage_) < 0 && errno == EINTR) continue;
    ended_ = true;
    return status;
  }
  double cpuSeconds() const {
    return static_cast<double>(usage_.ru_utime.tv_sec + usage_.ru_stime.tv_sec) +
           1e-6 * static_cast<double>(usage_.ru_utime.tv_usec + usage_.ru_stime.tv_usec);
  }

 private:
  pid_t id_ = -1;
  bool ended_ = false;
  rusage usage_{};
};

// Reads what the child sends while it works.
class Reader {
 public:
  Reader(int fd, double seconds)
      : fd_(fd),
        deadline_(Clock::now() +
                  std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds))) {}

  /// Returns false at the end of the stream or when time is up.
  bool read(void* to, std::size_t size) {
    for (char* at = static_cast<char*>(to); size > 0;) {
      if (!waitForBytes()) return false;
      const ssize_t n = ::read(fd_, at, size);
      if (n == 0 || (n < 0 && errno != EINTR)) return isAtEnd_ = true, false;
      if (n > 0) at += n, size -= static_cast<std::size_t>(n);
    }
    return true;
  }
  bool isAtEnd() const { return isAtEnd_; }
  bool isLate() const { return isLate_; }

 private:
  bool waitForBytes() {
    for (;;) {
      const auto left = std::chrono::ceil<std::chrono::milliseconds>(deadline_ - Clock::now()).count();
      isLate_ = left <= 0;
      if (isLate_) return false;
      pollfd polled[] = {{fd_, POLLIN, 0}, {stop_.fd(), POLLIN, 0}};
      const int ready = ::poll(polled, 2, static_cast<int>(std::min<long>(left, 1'000)));
      if (const int signal = ready > 0 && polled[1].revents != 0 ? stop_.take() : 0; signal != 0)
        throw Interrupted{signal};
      if (ready > 0 && polled[0].revents != 0) return true;
    }
  }

  int fd_;
  Clock::time_point deadline_;
  bool isAtEnd_ = false;
  bool isLate_ = false;
  StopRequests stop_;
};

IsolatedResult failureOf(int status, bool isLate, double cpuSeconds, const IsolationLimits& limits) {
  IsolatedResult result;
  if (WIFEXITED(status)) result.exitCode = WEXITSTATUS(status);
  if (WIFSIGNALED(status)) result.signal = WTERMSIG(status);
  const bool usedUp =
      result.signal == SIGXCPU || (result.signal == SIGKILL && cpuSeconds > limits.cpuSeconds);
  if (isLate || usedUp) result.end = IsolatedEnd::kTookTooLong;
  if (result.exitCode == kOutOfMemoryCode) result.end = IsolatedEnd::kOutOfMemory;
  return result;
}

}  // namespace

IsolatedResult callIsolated(const std::function<std::string()>& function, const IsolationLimits& limits) {
  constexpr int kPipeSize = 1 << 20;
  constexpr std::size_t kLeastLimit = 1 << 20;  // enough for the message of an Error
  Pipe pipe;
  ::fcntl(pipe.writeEnd(), F_SETPIPE_SZ, kPipeSize);
  Child child(function, limits, pipe);
  Reader reader(pipe.readEnd(), limits.wallSeconds);
  Head head;
  std::string bytes;
  bool isWhole = reader.read(&head, sizeof head) && head.size <= std::max(limits.memory, kLeastLimit);
  if (isWhole) {
    bytes.resize(head.size);
    isWhole = reader.read(bytes.data(), bytes.size());
  }
  char rest = 0;
  isWhole = isWhole && !reader.read(&rest, 1);
  const int status = reader.isAtEnd() ? child.wait() : child.end();
  if (!isWhole || status != 0) return failureOf(status, reader.isLate(), child.cpuSeconds(), limits);
  if (head.kind == Head::kError) throw Error(unpacked(bytes));
  return {.end = IsolatedEnd::kReturned, .exitCode = 0, .bytes = std::move(bytes)};
}

}  // namespace rex
