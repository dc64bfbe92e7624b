#include "base/isolated_call.h"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <new>
#include <string_view>

#include <fcntl.h>
#include <poll.h>
#include <sys/resource.h>
#include <unistd.h>

#include "base/child.h"
#include "base/child_internal.h"
#include "base/error.h"
#include "base/interruption.h"
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
  lowerCpuSeconds(limits.cpuSeconds);
  lowerLimit(RLIMIT_CORE, 0, 0);
  if (!kLimitsMemory) return;
  const rlim_t memory = presentSize() + limits.memory;
  lowerLimit(RLIMIT_AS, memory, memory);
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

// Stop requests that the parent holds back stay blocked.
void resetSignals(const sigset_t& held) {
  resetSignalHandlers();
  const sigset_t stop = stopSignals();
  sigset_t blocked;
  ::sigandset(&blocked, &stop, &held);
  ::sigprocmask(SIG_SETMASK, &blocked, nullptr);
}

// Runs in the child. An exception other than Error ends it, as none of the parent's code may run twice.
[[noreturn]] void answer(const std::function<std::string()>& function, const IsolationLimits& limits,
                         int result, const sigset_t& held) noexcept {
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
    const SignalsBlocked guard;
    id_ = forkChild("a process", [&] { answer(function, limits, pipe.writeEnd(), guard.before()); },
                    {.ownGroup = false});
    pipe.closeWrite();
  }
  ~Child() {
    if (!ended_) end();
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  /// Kills it, unless it has ended.
  ChildEnd end() {
    ::kill(id_, SIGKILL);
    return wait();
  }
  ChildEnd wait() {
    ended_ = true;
    return *waitForChild(id_);
  }

 private:
  pid_t id_ = -1;
  bool ended_ = false;
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

IsolatedResult failureOf(const ChildEnd& end, bool isLate, const IsolationLimits& limits) {
  IsolatedResult result{.signal = end.signal(), .exitCode = end.exitCode(), .bytes = {}};
  const bool usedUp =
      result.signal == SIGXCPU || (result.signal == SIGKILL && end.cpuSeconds > limits.cpuSeconds);
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
  const ChildEnd end = reader.isAtEnd() ? child.wait() : child.end();
  if (!isWhole || end.status != 0) return failureOf(end, reader.isLate(), limits);
  if (head.kind == Head::kError) throw Error(unpacked(bytes));
  return {.end = IsolatedEnd::kReturned, .exitCode = 0, .bytes = std::move(bytes)};
}

}  // namespace rex
