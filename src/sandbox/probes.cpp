#include "sandbox/probes.h"

#include <csignal>
#include <cstring>
#include <fstream>
#include <sstream>

#include <arpa/inet.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include "base/error.h"
#include "base/process.h"

namespace rex::sandbox {

std::string errorLine(const std::string& message) { return "error " + message + "\n"; }

std::string endLine(int status) { return fmt::format("end {}\n", status); }

Report readReport(const std::string& text) {
  Report report;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string kind;
    words >> kind;
    if (kind == "ready") report.ready = true;
    if (kind == "error") report.error = line.substr(6);
    int status = 0;
    if (kind == "end" && words >> status) report.status = status;
  }
  return report;
}

namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMegabytes = 256;
constexpr std::size_t kFileMegabytes = 64;
constexpr int kProcesses = 64;

/// The targets of the attacks: a file, a listening socket, an open descriptor, this process.
class Targets {
 public:
  explicit Targets(const fs::path& folder) : secret_(folder / "secret") {
    std::ofstream(secret_) << "secret\n";
    descriptor_ = ::open(secret_.c_str(), O_RDONLY);  // inherited, unless the sandbox closes it
    socket_ = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = ::htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof address;
    auto* const any = reinterpret_cast<sockaddr*>(&address);
    if (::bind(socket_, any, size) == 0 && ::listen(socket_, 4) == 0 &&
        ::getsockname(socket_, any, &size) == 0)
      port_ = ::ntohs(address.sin_port);
  }
  ~Targets() {
    ::close(descriptor_);
    ::close(socket_);
  }
  Targets(const Targets&) = delete;
  Targets& operator=(const Targets&) = delete;

  std::vector<std::string> file() const { return {"file", secret_.string(), secret_.parent_path().string()}; }
  std::vector<std::string> proc() const { return {"proc", fmt::format("{}", ::getpid())}; }
  std::vector<std::string> net() const { return {"net", fmt::format("{}", port_)}; }

 private:
  fs::path secret_;
  int descriptor_ = -1;
  int socket_ = -1;
  int port_ = 1;
};

ProcessResult run(const Sandbox& sandbox, const fs::path& probe, const std::vector<std::string>& words,
                  const fs::path& folder) {
  const Cell cell(sandbox, {.readable = {{probe, kInsideProgram}},
                            .cpuSeconds = 5,
                            .wallSeconds = 10,
                            .addressSpace = kMegabytes << 20,
                            .fileSize = kFileMegabytes << 20,
                            .processes = kProcesses});
  std::vector<std::string> program = {probe.string()};
  program.insert(program.end(), words.begin(), words.end());
  return runProcess(cell.command(program), {.directory = folder, .timeout = 15});
}

std::string firstLine(const std::string& text) { return text.substr(0, text.find('\n')); }

// Levels 2 and 3 pass signals on as codes above 128, as shells do.
int signalOf(const ProcessResult& result) {
  if (result.signal != 0) return result.signal;
  return result.exitCode > 128 ? result.exitCode - 128 : 0;
}

Probe judge(const std::string& name, const ProcessResult& result) {
  if (!result.started) return {name, false, "the launcher does not start: " + result.error, false};
  // The probe reports on standard output; bubblewrap complains on standard error with the same exit code.
  if (result.exitCode == 1 && !result.output.empty()) return {name, false, firstLine(result.output)};
  if (signalOf(result) == SIGSYS) return {name, true, "stopped at a forbidden system call"};
  if (signalOf(result) == SIGKILL || signalOf(result) == SIGXCPU) return {name, true, "killed"};
  if (result.exitCode == 0) return {name, true, "refused"};
  return {name, false,
          fmt::format("the sandbox cannot be set up: {}", firstLine(result.error + result.output)), false};
}

// Whether some process has this among its arguments; others may attack a sandbox at the same time.
bool isRunning(const std::string& argument) {
  std::error_code gone;
  for (const auto& entry : fs::directory_iterator("/proc", gone)) {
    std::ifstream file(entry.path() / "cmdline");
    for (std::string word; std::getline(file, word, '\0');)
      if (word == argument) return true;
  }
  return false;
}

Probe leftover(const Sandbox& sandbox, const fs::path& probe, const fs::path& folder) {
  const std::string mark = fmt::format("{}-{}", ::getpid(), folder.string());
  Probe result = judge("leftover", run(sandbox, probe, {"leftover", mark}, folder));
  if (result.held && isRunning(mark)) return {"leftover", false, "a process is still running"};
  return result;
}

}  // namespace

std::vector<Probe> attack(const Sandbox& sandbox, const fs::path& probe, const fs::path& folder) {
  const Targets targets(folder);
  std::vector<Probe> probes;
  const auto attempt = [&](const std::string& name, const std::vector<std::string>& words) {
    try {
      probes.push_back(judge(name, run(sandbox, probe, words, folder)));
    } catch (const Error& error) {
      probes.push_back({name, false, error.what(), false});
    }
  };
  attempt("file", targets.file());
  attempt("proc", targets.proc());
  attempt("net", targets.net());
  attempt("fork", {"fork", fmt::format("{}", kProcesses + 4)});
  attempt("exec", {"exec"});
  attempt("lock", {"lock"});
  attempt("calls", {"calls"});
  for (const char* call : {"ptrace", "unshare", "userfaultfd", "bpf"}) attempt(call, {"call", call});
  attempt("mem", {"mem", fmt::format("{}", kMegabytes)});
  attempt("fd", {"fd"});
  attempt("tmpfs size", {"tmpfs", fmt::format("{}", kFileMegabytes)});
  try {
    probes.push_back(leftover(sandbox, probe, folder));
  } catch (const Error& error) {
    probes.push_back({"leftover", false, error.what(), false});
  }
  return probes;
}

std::string whyNot(const Sandbox& sandbox, const fs::path& probe, const fs::path& folder) {
  try {
    const Targets targets(folder);
    std::vector<std::string> words;
    for (const auto& attack : {targets.file(), targets.proc(), targets.net(), {"fd"}, {"lock"}, {"calls"}})
      words.insert(words.end(), attack.begin(), attack.end());
    const Probe all = judge("all", run(sandbox, probe, words, folder));
    return all.held ? "" : all.text;
  } catch (const Error& error) {
    return error.what();
  }
}

Available bestLevel(const fs::path& launcher, const fs::path& probe, const fs::path& folder) {
  Available available;
  for (const Level level : kConfiningLevels) {
    const std::string reason = whyNot({.level = level, .launcher = launcher}, probe, folder);
    if (reason.empty()) {
      available.level = level;
      break;
    }
    available.reasons.push_back(fmt::format("level {}: {}", numberOf(level), reason));
  }
  return available;
}

}  // namespace rex::sandbox
