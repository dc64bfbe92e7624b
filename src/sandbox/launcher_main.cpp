// rex-sandbox: confines itself as its options say and becomes the program after "--". At levels 2 and 3 it
// runs bubblewrap, which starts it a second time as the first process inside. This one starts the program as
// its child, reports how it ended, and takes all remaining processes with it when it ends.
#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstring>
#include <fstream>

#include <fcntl.h>
#include <fmt/format.h>
#include <grp.h>
#include <linux/close_range.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/error.h"
#include "base/exit_code.h"
#include "sandbox/bubblewrap.h"
#include "sandbox/confinement.h"
#include "sandbox/landlock.h"
#include "sandbox/probes.h"
#include "sandbox/system_calls.h"
#include "sandbox/system_files_internal.h"

namespace rex::sandbox {
namespace {

constexpr const char* kInside = "--inside";

void tell(int fd, const std::string& text) { static_cast<void>(!::write(fd, text.data(), text.size())); }

void report(const Confinement& c, const std::string& text) {
  if (c.reports) tell(kReport, text);
}

// For tools, on standard error: nothing that a tool prints comes before this line, so a tool cannot make it
// look as if the sandbox had failed.
void reportReady(const Confinement& c) {
  report(c, kReady);
  if (!c.reports && c.mayStartProgramsOfItsOwn) tell(STDERR_FILENO, kReady);
}

void complain(const Confinement& c, const std::string& why) {
  c.reports ? tell(kReport, errorLine(why)) : tell(STDERR_FILENO, "sandbox: " + why + "\n");
}

[[noreturn]] void failWithCause(const std::string& what) {
  throw Error({.what = what, .found = std::strerror(errno)});
}

std::vector<char*> pointers(const std::vector<std::string>& texts) {
  std::vector<char*> list;
  for (const std::string& text : texts) list.push_back(const_cast<char*>(text.c_str()));
  list.push_back(nullptr);
  return list;
}

// A file in memory with the texts one after the other, which the next program inherits.
int memoryFile(const std::vector<std::string>& texts) {
  constexpr int kAboveFixed = 10;
  const int low = static_cast<int>(::memfd_create("rex", MFD_CLOEXEC));
  const int fd = ::fcntl(low, F_DUPFD, kAboveFixed);
  ::close(low);
  std::string content;
  for (const std::string& text : texts) content += text + '\0';
  if (fd < 0 || ::write(fd, content.data(), content.size()) != static_cast<ssize_t>(content.size()))
    failWithCause("cannot hand options to the sandbox");
  ::lseek(fd, 0, SEEK_SET);
  return fd;
}

std::vector<std::string> textsIn(int fd) {
  std::string content;
  std::array<char, 4096> buffer;
  for (ssize_t n = 1; n > 0;) {
    n = ::read(fd, buffer.data(), buffer.size());
    content.append(buffer.data(), static_cast<std::size_t>(std::max<ssize_t>(n, 0)));
  }
  std::vector<std::string> texts;
  for (std::size_t from = 0, to = 0; (to = content.find('\0', from)) != std::string::npos; from = to + 1)
    texts.push_back(content.substr(from, to - from));
  return texts;
}

void limit(__rlimit_resource resource, rlim_t soft, rlim_t hard) {
  const rlimit value{soft, hard};
  if (::setrlimit(resource, &value) != 0) failWithCause("cannot limit what the program may use");
}

// The kernel counts processes per user and user namespace. Their number can be limited only if this program
// has one of these for itself.
void setLimits(const Confinement& c) {
  const auto cpu = static_cast<rlim_t>(std::ceil(c.cpuSeconds));
  if (cpu > 0) limit(RLIMIT_CPU, cpu, cpu + 1);
  if (c.addressSpace > 0) limit(RLIMIT_AS, c.addressSpace, c.addressSpace);
  if (c.fileSize > 0) limit(RLIMIT_FSIZE, c.fileSize, c.fileSize);
  const auto files = static_cast<rlim_t>(c.openFiles), processes = static_cast<rlim_t>(c.processes);
  limit(RLIMIT_NOFILE, files, files);
  limit(RLIMIT_CORE, 0, 0);
  limit(RLIMIT_MSGQUEUE, 0, 0);
  if (hasNamespaces(c.level) || c.user) limit(RLIMIT_NPROC, processes, processes);
}

void becomeUser(const Confinement& c) {
  if (!c.user) return;
  if (::setgroups(0, nullptr) != 0 || ::setresgid(*c.user, *c.user, *c.user) != 0 ||
      ::setresuid(*c.user, *c.user, *c.user) != 0)
    failWithCause("cannot become another user");
}

// Opened before anything is forbidden, as its folder may be inaccessible to the user that we become.
int openProgram(const std::string& name) {
  int fd = ::open(name.c_str(), O_PATH | O_CLOEXEC);
  if (name.find('/') == std::string::npos) fd = ::open(("/usr/bin/" + name).c_str(), O_PATH | O_CLOEXEC);
  if (fd < 0) failWithCause("cannot run " + name);
  return fd;
}

ProgramStart startOf(const Order& order, int program) {
  std::vector<std::string> arguments = order.command;
  if (order.command.size() == 1) arguments[0] = "worker";
  return {program, hiddenWord(""), hiddenWords(arguments), hiddenWords(order.confinement.environment)};
}

// Becomes the program. If that fails, it is the file's own fault: too large, or not a program at all.
[[noreturn]] void become(const ProgramStart& start) {
  ::execveat(start.program, start.path, start.arguments, start.environment, AT_EMPTY_PATH);
  tell(STDERR_FILENO, fmt::format("{}: {}\n", start.arguments[0], std::strerror(errno)));
  ::_exit(127);
}

void setOut(const Order& order) {
  ::umask(022);
  const unsigned firstOfOthers = order.confinement.reports ? kReport : STDERR_FILENO + 1;
  ::close_range(firstOfOthers, ~0u, CLOSE_RANGE_CLOEXEC);
  setLimits(order.confinement);
}

// Whether a user who owns nothing can reach the path.
bool isOpenToAll(std::filesystem::path place) {
  for (struct stat status{}; ::stat(place.c_str(), &status) == 0; place = place.parent_path()) {
    const mode_t wanted = S_ISDIR(status.st_mode) ? S_IXOTH : S_IROTH;
    if ((status.st_mode & wanted) == 0) return false;
    if (place == place.root_path()) return true;
  }
  return true;
}

// At level 1 programs see the machine's own files. If only root can reach some of them, root stays root, but
// the next program starts without root's capabilities. Landlock applies to root, too.
void becomeUserOrPlainRoot(const Order& order) {
  const Confinement& c = order.confinement;
  if (!c.user) return;
  const auto isReached = [&](const Readable& readable) {
    return readable.path == order.command.front() || isOpenToAll(readable.path);
  };
  if (std::all_of(c.readable.begin(), c.readable.end(), isReached) &&
      (c.writable.empty() || isOpenToAll(c.writable.parent_path())))
    return becomeUser(c);
  if (!c.writable.empty() && ::lchown(c.writable.c_str(), 0, 0) != 0)
    failWithCause("cannot take the work folder back");
  for (int capability = 0; ::prctl(PR_CAPBSET_DROP, capability, 0, 0, 0) == 0; ++capability) {
  }
}

// Level 1: confines this very process.
[[noreturn]] void runAtLevelOne(const Order& order) {
  const Confinement& c = order.confinement;
  FileRules rules;
  const auto hidden = hiddenFolders(std::filesystem::read_symlink("/proc/self/exe"));
  for (const auto& path : allBut("/usr", hidden)) rules.allowReading(path);
  // On newer systems these are links to folders in /usr, which are allowed already.
  for (const char* name : kRootFolders)
    if (hidden.empty() || !std::filesystem::is_symlink(name)) rules.allowReading(name);
  for (const char* name : kSystemFiles) rules.allowReading(name);
  for (const char* name : kDevices) rules.allowWriting(name);
  if (!c.mayStartProgramsOfItsOwn)
    for (const char* name : kEndlessDevices) rules.allowWriting(name);
  for (const Readable& readable : c.readable) rules.allowReading(readable.path);
  if (!c.writable.empty()) rules.allowWriting(c.writable);
  const ProgramStart start = startOf(order, openProgram(order.command.front()));
  setOut(order);
  becomeUserOrPlainRoot(order);
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);  // a change of user resets it
  rules.enforce();
  filterSystemCalls(c, start);
  reportReady(c);
  become(start);
}

[[noreturn]] void runBubblewrap(const std::vector<std::string>& arguments, const Confinement& c) {
  const pid_t self = ::getpid();
  for (const auto& list : c.controlGroups) {
    std::ofstream group(list);
    group << self << std::flush;
    if (group.fail()) failWithCause("cannot join the control group");
  }
  const std::filesystem::path launcher = std::filesystem::read_symlink("/proc/self/exe");
  const int options = memoryFile(bubblewrapOptions(c, launcher));
  const int order = memoryFile(arguments);
  const std::vector<std::string> command = {"bwrap",         "--args", fmt::format("{}", options), "--",
                                            kInsideLauncher, kInside,  fmt::format("{}", order)};
  ::execvp(command[0].c_str(), pointers(command).data());
  failWithCause("cannot run bwrap from the package bubblewrap");
}

// Waits for the child and all other processes, so that their usage is counted. Returns the child's status.
int waitFor(pid_t child, double wallSeconds, bool& timedOut) {
  int status = 0;
  if (wallSeconds > 0) ::alarm(static_cast<unsigned>(std::ceil(wallSeconds)));
  for (pid_t ended = 0; ended != child;) {
    ended = ::waitpid(-1, &status, 0);
    if (ended >= 0 || errno != EINTR) continue;
    timedOut = true;
    ::kill(-1, SIGKILL);
  }
  ::kill(-1, SIGKILL);
  int ignored = 0;
  while (::waitpid(-1, &ignored, 0) > 0) {
  }
  return status;
}

[[noreturn]] void becomeInside(const Order& order) {
  ::setpgid(0, 0);
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  const Confinement& c = order.confinement;
  const std::string program = insidePath(c, order.command.front());
  const std::string folder = c.writable.empty() ? kInsideFolder : c.writable.string();
  const ProgramStart start = startOf(order, openProgram(program));
  setOut(order);
  becomeUser(c);
  // The folder belongs to that user; root has no special rights here.
  if (::chdir(folder.c_str()) != 0) failWithCause("cannot enter the work folder");
  filterSystemCalls(c, start);
  reportReady(c);
  become(start);
}

// The first process inside. Others inside must not look into it, even if they belong to the same user.
int runInside(const Order& order) {
  ::prctl(PR_SET_DUMPABLE, 0);
  struct sigaction wake {};
  wake.sa_handler = [](int) {};
  ::sigaction(SIGALRM, &wake, nullptr);
  const pid_t child = ::fork();
  if (child < 0) failWithCause("cannot start the program");
  if (child == 0) {
    try {
      becomeInside(order);
    } catch (const Error& error) {
      complain(order.confinement, error.what());
      ::_exit(numberOf(ExitCode::kNotStarted));
    }
  }
  // Only the program may hold the ends of the pipes, so that the other side notices when it closes them.
  for (int fd = 0; fd < kReport; ++fd) ::close(fd);
  bool timedOut = false;
  const int status = waitFor(child, order.confinement.wallSeconds, timedOut);
  report(order.confinement, endLine(status));
  if (timedOut) return numberOf(ExitCode::kTimedOut);
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

int run(const Order& order, const std::vector<std::string>& arguments) {
  const Confinement& c = order.confinement;
  if (hasNamespaces(c.level)) runBubblewrap(arguments, c);
  if (isConfined(c.level)) runAtLevelOne(order);
  const ProgramStart start = startOf(order, openProgram(order.command.front()));
  setOut(order);
  become(start);
}

int confine(std::vector<std::string> arguments) {
  Order order;
  try {
    const bool inside = arguments.size() == 2 && arguments[0] == kInside;
    if (inside) {
      const int file = std::stoi(arguments[1]);
      arguments = textsIn(file);
      ::close(file);
    }
    order = orderFromArguments(arguments);
    return inside ? runInside(order) : run(order, arguments);
  } catch (const std::exception& error) {
    complain(order.confinement, error.what());
    return numberOf(ExitCode::kNotStarted);
  }
}

}  // namespace
}  // namespace rex::sandbox

int main(int argc, char** argv) { return rex::sandbox::confine({argv + 1, argv + argc}); }
