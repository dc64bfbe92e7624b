// rex-sandbox-probe: attacks from inside, for the probes of probes.h. Every attack ends with code 0 if the
// sandbox held, and reports on standard output what it found.
#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include <arpa/inet.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <netinet/in.h>
#include <sys/file.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

namespace {

using Words = std::vector<std::string>;

// Returns what got through; empty: nothing.
using Attack = std::function<std::string(const Words&)>;

bool opens(const std::string& file, int how) {
  const int fd = ::open(file.c_str(), how | O_CLOEXEC, 0600);
  if (fd >= 0) ::close(fd);
  return fd >= 0;
}

// Words: a secret file, a folder outside.
std::string readAndWriteFiles(const Words& words) {
  for (const std::string& file : {words.at(0), std::string("/etc/passwd"), std::string("/etc/shadow")})
    if (opens(file, O_RDONLY)) return "read " + file;
  for (const std::string& folder :
       {words.at(1), std::string("/usr"), std::string("/var/tmp"), std::string("/dev")})
    if (opens(folder + "/rex-probe", O_WRONLY | O_CREAT)) return "wrote into " + folder;
  if (::chmod(words.at(0).c_str(), 0) == 0) return "changed the permissions of " + words.at(0);
  if (::truncate(words.at(0).c_str(), 0) == 0) return "emptied " + words.at(0);
  return "";
}

// Words: ID of a process of ours outside.
std::string reachProcesses(const Words& words) {
  const pid_t victim = std::stoi(words.at(0));
  const std::string folder = "/proc/" + words.at(0);
  for (const char* file : {"/environ", "/mem", "/cmdline", "/fd/0"})
    if (opens(folder + file, O_RDONLY)) return "opened " + folder + file;
  if (::kill(victim, 0) == 0) return "can send signals to process " + words.at(0);
  if (::fcntl(STDIN_FILENO, F_SETOWN, victim) == 0) return "can have signals sent to process " + words.at(0);
  if (::setpriority(PRIO_PROCESS, static_cast<id_t>(victim), 0) == 0)
    return "can slow process " + words.at(0);
  return "";
}

// Words: port of a listener outside.
std::string reachNetwork(const Words& words) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = ::htons(static_cast<std::uint16_t>(std::stoi(words.at(0))));
  address.sin_addr.s_addr = ::htonl(INADDR_LOOPBACK);
  const int tcp = ::socket(AF_INET, SOCK_STREAM, 0);
  if (tcp >= 0 && ::connect(tcp, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0)
    return "connected to a program outside";
  for (const int family : {AF_INET, AF_INET6, AF_UNIX, AF_NETLINK})
    if (::socket(family, SOCK_DGRAM, 0) >= 0) return fmt::format("made a socket of family {}", family);
  return "";
}

std::string findDescriptors(const Words&) {
  for (int fd = 3; fd < 1024; ++fd)
    if (::fcntl(fd, F_GETFD) >= 0) return fmt::format("descriptor {} is open", fd);
  return "";
}

// A sandbox that forbids new processes kills this one; one that counts them refuses in time.
std::string startProcesses(const Words& words) {
  const int allowed = std::stoi(words.at(0));
  std::vector<pid_t> children;
  for (int k = 0; k < 2 * allowed; ++k) {
    const pid_t child = ::fork();
    if (child == 0) {
      ::alarm(5);
      ::pause();
      ::_exit(0);
    }
    if (child < 0) break;
    children.push_back(child);
  }
  for (const pid_t child : children) ::kill(child, SIGKILL);
  const auto count = static_cast<int>(children.size());
  return count > allowed ? fmt::format("started {} processes", count) : "";
}

// Words: megabytes that it may have.
std::string takeMemory(const Words& words) {
  const std::size_t allowed = std::stoul(words.at(0)), step = 16;
  for (std::size_t taken = 0; taken < 2 * allowed; taken += step) {
    void* memory = ::mmap(nullptr, step << 20, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (memory == MAP_FAILED) return "";
    std::memset(memory, 1, step << 20);
  }
  return fmt::format("took {} MB", 2 * allowed);
}

// Words: megabytes of files that it may write.
std::string fillFolders(const Words& words) {
  const std::size_t allowed = std::stoul(words.at(0));
  std::size_t written = 0;
  const std::string block(1u << 20, 'x');
  for (const char* folder : {".", "/tmp", "/dev/shm", "/dev", "/", "/var/tmp", "/run"}) {
    for (int k = 0; k < 8 && written < 2 * allowed; ++k) {
      const std::string name = fmt::format("{}/rex-probe-{}-{}", folder, ::getpid(), k);
      const int fd = ::open(name.c_str(), O_WRONLY | O_CREAT | O_EXCL, 0600);
      for (std::size_t megabyte = 0; fd >= 0 && megabyte < allowed / 4; ++megabyte)
        written += ::write(fd, block.data(), block.size()) == static_cast<ssize_t>(block.size()) ? 1 : 0;
      if (fd >= 0) ::close(fd);
    }
  }
  return written > allowed ? fmt::format("wrote {} MB", written) : "";
}

// Stays behind in a session of its own. Whether that worked is checked from outside.
std::string stayBehind(const Words&) {
  if (::fork() == 0) {
    ::setsid();
    if (::fork() == 0) {
      ::alarm(20);
      ::pause();
    }
    ::_exit(0);
  }
  return "";
}

// Replaces this program with another. One that starts ends with an exit code of its own.
std::string startAnother(const Words&) {
  std::string shell = "/bin/sh", option = "-c", said = "echo a shell took the place of the program; exit 1";
  char* words[] = {shell.data(), option.data(), said.data(), nullptr};
  const int fd = ::open(shell.c_str(), O_PATH);
  ::syscall(SYS_execveat, fd, "", words, ::environ, AT_EMPTY_PATH);
  ::execve(shell.c_str(), words, ::environ);
  return "";
}

// Locks a file of the system; other programs would notice.
std::string lockFiles(const Words&) {
  const int fd = ::open("/usr/bin/env", O_RDONLY);
  if (::flock(fd, LOCK_SH | LOCK_NB) == 0) return "locked a file of the system";
  for (const int command : {F_SETLK, F_OFD_SETLK}) {
    struct flock lock {};
    lock.l_type = F_RDLCK;
    if (::fcntl(fd, command, &lock) == 0) return "locked part of a file of the system";
  }
  return "";
}

// Calls that are known for security holes, and calls added after the filter was written.
std::string makeOddCalls(const Words&) {
  const std::pair<const char*, long> calls[] = {{"io_uring_setup", SYS_io_uring_setup},
                                                {"memfd_create", SYS_memfd_create},
                                                {"inotify_init1", SYS_inotify_init1},
                                                {"seccomp", SYS_seccomp}};
  for (const auto& [name, number] : calls)
    if (::syscall(number, 0, 0, 0) >= 0 || (errno != EPERM && errno != ENOSYS))
      return fmt::format("can call {}", name);
  for (long number = 463; number < 600; ++number)
    if (::syscall(number, -1, 0, 0, 0, 0, 0) >= 0 || errno != ENOSYS)
      return fmt::format("can call {}", number);
  return "";
}

// A call that makes the filter end the program.
std::string makeHostileCall(const Words& words) {
  const std::map<std::string, long> calls = {
      {"ptrace", SYS_ptrace}, {"unshare", SYS_unshare}, {"userfaultfd", SYS_userfaultfd}, {"bpf", SYS_bpf}};
  return ::syscall(calls.at(words.at(0)), 0, 0, 0, 0) >= 0 || errno != EPERM ? "can call " + words.at(0) : "";
}

const std::map<std::string, std::pair<int, Attack>>& attacks() {
  static const std::map<std::string, std::pair<int, Attack>> all = {
      {"file", {2, readAndWriteFiles}}, {"proc", {1, reachProcesses}}, {"net", {1, reachNetwork}},
      {"fork", {1, startProcesses}},    {"mem", {1, takeMemory}},      {"fd", {0, findDescriptors}},
      {"tmpfs", {1, fillFolders}},      {"leftover", {1, stayBehind}}, {"exec", {0, startAnother}},
      {"lock", {0, lockFiles}},         {"calls", {0, makeOddCalls}},  {"call", {1, makeHostileCall}}};
  return all;
}

}  // namespace

// Arguments: attack words... attack words...
int main(int argc, char** argv) {
  const Words arguments(argv + 1, argv + argc);
  for (std::size_t k = 0; k < arguments.size();) {
    const auto& [count, attack] = attacks().at(arguments[k]);
    const auto first = arguments.begin() + static_cast<long>(k) + 1;
    const std::string through = attack(Words(first, first + count));
    if (!through.empty()) {
      fmt::print("{}\n", through);
      return 1;
    }
    k += 1 + static_cast<std::size_t>(count);
  }
}
