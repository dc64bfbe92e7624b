#include "grading/worker_process.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstring>
#include <optional>
#include <random>
#include <stdexcept>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <linux/close_range.h>
#include <poll.h>
#include <sched.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/child.h"
#include "base/error.h"
#include "base/folders.h"
#include "grading/descendants.h"
#include "grading/output_capture.h"
#include "remote/channel.h"
#include "remote/worker.h"
#include "sandbox/confinement.h"
#include "sandbox/leave_others.h"
#include "sandbox/probes.h"

namespace rex::grading {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

double secondsSince(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

#ifdef __SANITIZE_ADDRESS__
constexpr bool kLimitMemory = false;
// Crashes keep their signals, findings abort, and memory that a killed worker leaves behind is not a leak.
constexpr std::array<const char*, 3> kEnvironment = {
    "ASAN_OPTIONS=handle_segv=0:handle_sigbus=0:handle_sigfpe=0:handle_sigill=0:abort_on_error=1:detect_"
    "leaks=0",
    "UBSAN_OPTIONS=abort_on_error=1", nullptr};
#else
constexpr bool kLimitMemory = true;
constexpr std::array<const char*, 1> kEnvironment = {nullptr};
#endif

constexpr std::size_t kLargestFile = 64u << 20;
constexpr rlim_t kOpenFiles = 64;

int notBlocking(int fd) {
  ::fcntl(fd, F_SETFL, O_NONBLOCK);
  return fd;
}

/// A started process and our ends of its pipes, which do not block. The receiver owns the descriptors.
struct Launched {
  pid_t process = -1;
  int processFd = -1;  ///< readable once the process has ended
  int toWorker = -1;
  int fromWorker = -1;
  int output = -1;
  int error = -1;
  int report = -1;  ///< what the launcher says; -1 at level 0
};

/// A confinement's command, started by its launcher; without one, level 0, the program itself.
struct LaunchOrder {
  std::vector<std::string> command{};  ///< path and arguments; one path alone runs under the name "worker"
  std::string name{};                  ///< of the program, in messages
  std::filesystem::path folder{};      ///< to work in
  Limits limits{};                     ///< set here at level 0, by the launcher above
  sandbox::Level level = sandbox::Level::kLimitsOnly;
};

void setLimits(const Limits& limits) {
  lowerCpuSeconds(limits.cpuBudget());
  lowerLimit(RLIMIT_FSIZE, kLargestFile, kLargestFile);
  lowerLimit(RLIMIT_NOFILE, kOpenFiles, kOpenFiles);
  lowerLimit(RLIMIT_CORE, 0, 0);
  if (kLimitMemory && !limits.sanitized) lowerLimit(RLIMIT_AS, limits.memory, limits.memory);
}

// In the new process, which uses our memory until execve: only async-signal-safe calls are allowed. `fds`
// become descriptors 1, 2, ...
void execWorker(const LaunchOrder& order, char* const* arguments, const std::vector<int>& fds, int status) {
  ::close(STDIN_FILENO);
  static_cast<void>(::open("/dev/null", O_RDONLY));  // gets the lowest number that is free
  int next = STDIN_FILENO;
  for (const int fd : fds) ::dup2(fd, ++next);
  ::close_range(static_cast<unsigned>(next) + 1, ~0u, CLOSE_RANGE_CLOEXEC);
  resetSignalHandlers();
  ::signal(SIGPIPE, SIG_DFL);
  sigset_t none;
  ::sigemptyset(&none);
  ::sigprocmask(SIG_SETMASK, &none, nullptr);
  if (::chdir(order.folder.c_str()) == 0) {
    if (!sandbox::isConfined(order.level)) {
      setLimits(order.limits);
      sandbox::leaveOthersAlone();
    }
    ::execve(order.command.front().c_str(), arguments, const_cast<char* const*>(kEnvironment.data()));
  }
  const int cause = errno;
  static_cast<void>(!::write(status, &cause, sizeof cause));
}

std::vector<char*> readArguments(const LaunchOrder& order) {
  static const std::string kName = "worker";
  std::vector<char*> arguments;
  for (const std::string& word : order.command) arguments.push_back(const_cast<char*>(word.c_str()));
  if (arguments.size() == 1) arguments[0] = const_cast<char*>(kName.c_str());
  arguments.push_back(nullptr);
  return arguments;
}

// Starts it in its own process group with an empty environment, before its first instruction with its
// limits, and with no descriptor but the standard ones, its two pipes and a launcher's report. It dies with
// this process. Throws Error if it cannot be started.
Launched launchWorker(const LaunchOrder& order) {
  static_assert(remote::kWorkerIn == 3 && remote::kWorkerOut == 4 && sandbox::kReport == 5);
  Pipe in, out, output, error, status;
  std::optional<Pipe> report;
  const std::vector<char*> arguments = readArguments(order);
  std::vector<int> fds{output.writeEnd(), error.writeEnd(), in.readEnd(), out.writeEnd()};
  if (sandbox::isConfined(order.level)) fds.push_back(report.emplace().writeEnd());
  pid_t child = -1;
  {
    // A grader holds much memory, and a copy of its page tables would cost more than all else here.
    const SignalsBlocked guard;
    child = forkChild("the worker", [&] { execWorker(order, arguments.data(), fds, status.writeEnd()); },
                      {.sharesMemory = true});
  }
  status.closeWrite();
  int cause = 0;
  if (::read(status.readEnd(), &cause, sizeof cause) == sizeof cause) {
    waitForChild(child);
    throw Error({.what = "cannot start the worker " + order.name, .found = std::strerror(cause)});
  }
  return {.process = child,
          .processFd = static_cast<int>(::syscall(SYS_pidfd_open, child, 0)),
          .toWorker = notBlocking(in.releaseWrite()),
          .fromWorker = notBlocking(out.releaseRead()),
          .output = notBlocking(output.releaseRead()),
          .error = notBlocking(error.releaseRead()),
          .report = report ? notBlocking(report->releaseRead()) : -1};
}

/// Thrown when we stop waiting for the worker for a known reason.
class GaveUp : public remote::Closed {
 public:
  explicit GaveUp(Failure why) : Closed(why.message), failure(std::move(why)) {}
  Failure failure;
};

/// Keeps this thread, and the processes it starts, on one core: a call between two cores takes ten times as
/// long. Neighbours with other process ids take other cores.
class OneCore {
 public:
  OneCore() {
    ::sched_getaffinity(0, sizeof before_, &before_);
    int skipped = ::getpid() % std::max(CPU_COUNT(&before_), 1);
    std::size_t core = 0;
    while (core < CPU_SETSIZE && (!CPU_ISSET(core, &before_) || skipped-- > 0)) ++core;
    cpu_set_t one;
    CPU_ZERO(&one);
    CPU_SET(core, &one);
    ::sched_setaffinity(0, sizeof one, &one);
  }
  ~OneCore() { ::sched_setaffinity(0, sizeof before_, &before_); }
  OneCore(const OneCore&) = delete;
  OneCore& operator=(const OneCore&) = delete;

 private:
  cpu_set_t before_;
};

sandbox::Confinement confinementOf(const GradingJob& job, const fs::path& program) {
  if (!sandbox::isConfined(job.sandbox.level)) return {};
  sandbox::Confinement confinement{.readable = {{fs::absolute(program), sandbox::kInsideProgram}},
                                   .cpuSeconds = job.limits.cpuBudget(),
                                   .addressSpace = job.limits.memory,
                                   .fileSize = kLargestFile,
                                   .reports = true};
  for (const fs::path& library : job.libraries) confinement.readable.push_back({library, library});
  return confinement;
}

LaunchOrder orderOf(const GradingJob& job, const fs::path& program, const sandbox::Cell& cell,
                    const fs::path& folder) {
  const std::string whole = fs::absolute(program).string();
  const sandbox::Level level = job.sandbox.level;
  return {.command = sandbox::isConfined(level) ? cell.command({whole}) : std::vector{whole},
          .name = program.string(),
          .folder = folder,
          .limits = job.limits,
          .level = level};
}

class Worker {
 public:
  Worker(const GradingJob& job, const fs::path& program, double patience);
  ~Worker();
  Worker(const Worker&) = delete;
  Worker& operator=(const Worker&) = delete;

  void converse(std::uint64_t signature, const std::function<void(remote::Caller&)>& conversation);
  Failure explain(const remote::Closed& reason);
  Failure explain(const remote::ProtocolError& reason) const;
  /// Ends the worker and everything it left behind, and returns what it used.
  WorkerRun end();
  /// The student's function that is running, or was running when the worker ended badly.
  const std::string& running() const { return caller_.running(); }

 private:
  void waitFor(int fd, remote::Channel::Direction direction);
  double budget() const { return ready_ ? job_.limits.wallBudget() : job_.limits.startBudget(); }
  Failure tooLate() const;
  void drain();
  bool waitForEnd(double seconds);
  void readReport();
  bool saidItsEnd();
  int trueStatus();
  void killAll();
  std::string place() const { return failurePlace(ready_, caller_.running()); }

  const GradingJob& job_;
  const double patience_;
  SigpipeIgnored sigpipe_;
  OneCore core_;
  NewDescendants descendants_;
  sandbox::Cell cell_;
  PrivateFolder folder_;
  Launched launched_;
  OutputCapture output_;
  OutputCapture error_;
  remote::Caller caller_;
  double waited_ = 0;
  bool ready_ = false;
  bool over_ = false;
  std::optional<ChildEnd> end_{};  // once it has been reaped
  std::string report_{};
};

// The ids of the messages are random so that the worker cannot predict them; they influence no result.
Worker::Worker(const GradingJob& job, const fs::path& program, double patience)
    : job_(job),
      patience_(patience),
      cell_(job.sandbox, confinementOf(job, program)),
      folder_(job.temporaryFolder),
      launched_(launchWorker(orderOf(job, program, cell_, folder_.path()))),
      output_(launched_.output),
      error_(launched_.error),
      caller_(
          remote::Channel(launched_.fromWorker, launched_.toWorker,
                          [this](int fd, remote::Channel::Direction direction) { waitFor(fd, direction); }),
          std::random_device()()) {}

Worker::~Worker() {
  killAll();
  for (const int fd : {launched_.processFd, launched_.toWorker, launched_.fromWorker, launched_.report})
    if (fd >= 0) ::close(fd);
}

void Worker::converse(std::uint64_t signature, const std::function<void(remote::Caller&)>& conversation) {
  caller_.handshake(signature);
  // Loading a program and its sandbox is not charged to the student.
  ready_ = true;
  waited_ = 0;
  conversation(caller_);
}

Failure Worker::tooLate() const {
  return {.outcome = Outcome::kTimeLimit,
          .message = fmt::format("stopped after {:.1f} s {} (asleep, blocked, or in an infinite loop?)",
                                 budget(), place()),
          .mayBeOfMachine = true};
}

// Only the time that we wait counts: the grader's own work is not charged to the student. Between two looks
// at its output there is a pause, so that a program cannot make us work by what it prints.
void Worker::waitFor(int fd, remote::Channel::Direction direction) {
  constexpr double kPause = 0.002;
  const short events = direction == remote::Channel::Direction::kRead ? POLLIN : POLLOUT;
  const auto start = Clock::now();
  const double before = waited_;
  bool ended = false, printed = false;
  for (;;) {
    waited_ = before + secondsSince(start);
    const double left = patience_ * budget() - waited_;
    if (left <= 0) throw GaveUp(tooLate());
    const double seconds = ended ? 0 : printed ? std::min(left, kPause) : left;
    std::array<pollfd, 4> polled{{{fd, events, 0},
                                  {launched_.processFd, POLLIN, 0},
                                  {printed ? -1 : output_.fd(), POLLIN, 0},
                                  {printed ? -1 : error_.fd(), POLLIN, 0}}};
    ::poll(polled.data(), polled.size(), static_cast<int>(std::min(std::ceil(seconds * 1000), 1e6)));
    printed = polled[2].revents != 0 || polled[3].revents != 0;
    if (printed) drain();
    if (polled[0].revents != 0) break;
    // A last message may arrive while poll() looks at one descriptor after the other: poll once more.
    if (polled[1].revents != 0 && std::exchange(ended, true)) throw remote::Closed("the worker ended");
  }
  waited_ = before + secondsSince(start);
}

void Worker::drain() {
  output_.drain();
  error_.drain();
  const std::size_t limit = job_.limits.output;
  if (output_.total() + error_.total() > limit)
    throw GaveUp({.outcome = Outcome::kOutputLimit,
                  .message = fmt::format("printed more than {} MB {}", limit / kMegabyte, place())});
}

bool Worker::waitForEnd(double seconds) {
  const auto start = Clock::now();
  while (!end_ && secondsSince(start) < seconds) {
    pollfd polled{launched_.processFd, POLLIN, 0};
    ::poll(&polled, 1, 10);
    output_.drain();
    error_.drain();
    end_ = waitForChild(launched_.process, WNOHANG);
  }
  return end_.has_value();
}

void Worker::readReport() {
  std::array<char, 1024> buffer;
  for (ssize_t n = 1; launched_.report >= 0 && n > 0;) {
    n = ::read(launched_.report, buffer.data(), buffer.size());
    if (n > 0) report_.append(buffer.data(), static_cast<std::size_t>(n));
  }
}

// True if the program has ended and only its sandbox is still being taken down.
bool Worker::saidItsEnd() {
  readReport();
  return sandbox::readReport(report_).status.has_value();
}

// How the program ended, as reported by the launcher if there is one between us. If the launcher fails before
// the program starts, that is our fault; if it fails later, the program brought it down.
int Worker::trueStatus() {
  const sandbox::Level level = job_.sandbox.level;
  if (!sandbox::isConfined(level)) return end_->status;
  readReport();
  const sandbox::Report report = sandbox::readReport(report_);
  if (!report.error.empty() || !report.ready)
    throw Error({.what = fmt::format("the sandbox of level {} cannot be set up", sandbox::numberOf(level)),
                 .found = report.error.empty() ? tellingLine(error_.tail()) : report.error});
  return sandbox::hasNamespaces(level) ? report.status.value_or(SIGKILL) : end_->status;
}

Failure Worker::explain(const remote::Closed& reason) {
  if (const auto* known = dynamic_cast<const GaveUp*>(&reason)) return known->failure;
  constexpr double kPatience = 1;
  if (!waitForEnd(kPatience) && !(saidItsEnd() && waitForEnd(10 * kPatience)))
    return {.outcome = Outcome::kProtocolError, .message = "closed its connection to the grader " + place()};
  return explainEnd({.status = trueStatus(),
                     .cpuSeconds = end_->cpuSeconds,
                     .ready = ready_,
                     .function = caller_.running(),
                     .errorTail = error_.tail(),
                     .outOfMemory = cell_.ranOutOfMemory()},
                    job_.limits);
}

Failure Worker::explain(const remote::ProtocolError& reason) const {
  return {.outcome = Outcome::kProtocolError,
          .message = fmt::format("corrupted the connection to the grader {}: {}", place(), reason.what())};
}

void Worker::killAll() {
  if (std::exchange(over_, true)) return;
  // Its group first: until the leader is reaped, no other process can get its number.
  if (!end_) {
    ::kill(-launched_.process, SIGKILL);
    ::kill(launched_.process, SIGKILL);
    end_ = waitForChild(launched_.process);
  }
  cell_.kill();
  descendants_.kill();
}

WorkerRun Worker::end() {
  killAll();
  output_.drain();
  error_.drain();
  const long peak = std::max(end_->peakKilobytes, descendants_.peakKilobytes());
  return {.cpuSeconds = end_->cpuSeconds + descendants_.cpuSeconds(),
          .wallSeconds = waited_,
          .peakMemoryBytes = static_cast<std::int64_t>(peak) * 1024,
          .output = {output_.head(), output_.total()},
          .error = {error_.head(), error_.total()}};
}

}  // namespace

WorkerRun runWithWorker(const GradingJob& job, const std::string& part, std::uint64_t signature,
                        const std::function<void(remote::Caller&)>& conversation, double patience) {
  Worker worker(job, workerProgram(part, job), patience);
  std::optional<Failure> failure;
  try {
    worker.converse(signature, conversation);
  } catch (const remote::Closed& reason) {
    failure = worker.explain(reason);
  } catch (const remote::ProtocolError& reason) {
    failure = worker.explain(reason);
  } catch (const remote::RemoteThrow& error) {
    failure = explainThrow(error, job.limits);
  }
  if (failure && failure->function.empty()) failure->function = worker.running();
  WorkerRun run = worker.end();
  run.failure = std::move(failure);
  return run;
}

std::optional<double> slownessOfMachine(const GradingJob& job, std::uint64_t signature) {
  if (job.control.empty()) return 1;
  GradingJob control = job;
  control.worker = job.control;
  control.parts.clear();
  const WorkerRun run = runWithWorker(control, "", signature, [](remote::Caller& caller) {
    static_cast<void>(caller.call(0, "the control", remote::Writer(), {}));
  });
  if (run.failure) return {};
  return std::max(1., run.wallSeconds / remote::kControlSeconds);
}

}  // namespace rex::grading
