#include "sandbox/cell.h"

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <map>
#include <random>
#include <sstream>
#include <string>
#include <thread>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/error.h"

namespace rex::sandbox {
namespace {

namespace fs = std::filesystem;

bool write(const fs::path& file, const std::string& text) {
  std::ofstream stream(file);
  stream << text;
  stream.close();
  return !stream.fail();
}

std::string read(const fs::path& file) {
  std::ifstream stream(file);
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

// The mount point of each kind of control group: "" is version 2, the others are controllers of version 1.
std::map<std::string, fs::path> mounts() {
  std::map<std::string, fs::path> found;
  std::ifstream file("/proc/self/mounts");
  std::string device, folder, type, options;
  for (std::string line; std::getline(file, line);) {
    std::istringstream words(line);
    if (!(words >> device >> folder >> type >> options)) continue;
    if (type == "cgroup2") found[""] = folder;
    if (type != "cgroup") continue;
    for (const char* controller : {"memory", "pids"})
      if (("," + options + ",").find(fmt::format(",{},", controller)) != std::string::npos)
        found[controller] = folder;
  }
  return found;
}

// The group of this process, relative to the mount point of version 2.
fs::path ownGroup() {
  std::ifstream file("/proc/self/cgroup");
  for (std::string line; std::getline(file, line);)
    if (line.starts_with("0::/")) return line.substr(4);
  return {};
}

// The owner's process ID in a name that freshName() made; 0: not one of ours.
pid_t ownerOf(const std::string& name) {
  int owner = 0;
  return std::sscanf(name.c_str(), "rex-%d-", &owner) == 1 ? owner : 0;
}

// Process IDs are reused, so the rest of the name is random.
std::string freshName() { return fmt::format("rex-{}-{:08x}", ::getpid(), std::random_device()()); }

// Removes groups whose owners were killed. The kernel keeps those that hold a process.
void removeAbandoned(const fs::path& parent) {
  std::error_code ignored;
  for (fs::directory_iterator entry(parent, ignored), end; entry != end; entry.increment(ignored)) {
    const pid_t owner = ownerOf(entry->path().filename().string());
    if (owner > 0 && ::kill(owner, 0) != 0 && errno == ESRCH) ::rmdir(entry->path().c_str());
  }
}

}  // namespace

ControlGroup::ControlGroup(std::size_t memoryBytes, int processes) {
  if (tryVersion2(memoryBytes, processes) || tryVersion1(memoryBytes, processes)) return;
  throw Error({.what = "cannot make a control group for memory and processes here"});
}

ControlGroup::~ControlGroup() {
  kill();
  remove();
}

// Below our own group if we may divide it, else below the top.
bool ControlGroup::tryVersion2(std::size_t memoryBytes, int processes) {
  const auto all = mounts();
  const auto mount = all.find("");
  if (mount == all.end()) return false;
  for (const fs::path& parent : {mount->second / ownGroup(), mount->second}) {
    removeAbandoned(parent);
    const fs::path folder = parent / freshName();
    std::error_code refused;
    if (!fs::create_directory(folder, refused)) continue;
    folders_ = {folder};
    if (fs::exists(folder / "memory.max") && fs::exists(folder / "pids.max") &&
        write(folder / "memory.max", fmt::format("{}", memoryBytes)) &&
        write(folder / "pids.max", fmt::format("{}", processes))) {
      write(folder / "memory.swap.max", "0");
      return true;
    }
    remove();
  }
  return false;
}

bool ControlGroup::tryVersion1(std::size_t memoryBytes, int processes) {
  const std::string name = freshName();
  for (const auto& [controller, mount] : mounts()) {
    if (controller.empty()) continue;
    removeAbandoned(mount);
    std::error_code refused;
    if (fs::create_directory(mount / name, refused)) folders_.push_back(mount / name);
  }
  const auto limit = [&](const char* file, std::size_t value) {
    bool done = false;
    for (const fs::path& folder : folders_)
      done = done || (fs::exists(folder / file) && write(folder / file, fmt::format("{}", value)));
    return done;
  };
  if (limit("memory.limit_in_bytes", memoryBytes) && limit("pids.max", static_cast<std::size_t>(processes))) {
    limit("memory.memsw.limit_in_bytes", memoryBytes);  // memory and swap, if swap is counted
    return true;
  }
  remove();
  return false;
}

std::vector<fs::path> ControlGroup::processes() const {
  std::vector<fs::path> lists;
  for (const fs::path& folder : folders_) lists.push_back(folder / "cgroup.procs");
  return lists;
}

bool ControlGroup::ranOutOfMemory() const {
  for (const fs::path& folder : folders_) {
    for (const char* file : {"memory.events", "memory.oom_control"}) {
      std::istringstream words(read(folder / file));
      std::string name;
      for (long count = 0; words >> name >> count;)
        if (name == "oom_kill" && count > 0) return true;
    }
  }
  return false;
}

void ControlGroup::kill() const {
  for (const fs::path& folder : folders_) {
    if (fs::exists(folder / "cgroup.kill") && write(folder / "cgroup.kill", "1")) continue;
    std::ifstream list(folder / "cgroup.procs");
    for (pid_t process = 0; list >> process;)
      if (process > 1 && process != ::getpid()) ::kill(process, SIGKILL);
  }
}

// Killed processes take a moment to disappear.
void ControlGroup::remove() {
  for (const fs::path& folder : folders_) {
    for (int attempt = 0; attempt < 400 && ::rmdir(folder.c_str()) != 0 && errno == EBUSY; ++attempt) {
      std::this_thread::sleep_for(std::chrono::microseconds(attempt < 20 ? 200 : 5000));
      if (attempt % 20 == 19) kill();
    }
  }
  folders_.clear();
}

namespace {

// User IDs that neither Debian nor systemd assigns: 60706 to 61183.
constexpr unsigned kFirst = 60706;
constexpr int kSlots = 256;
constexpr const char* kFolder = "/run/rex-slots";

}  // namespace

UserSlot::UserSlot() {
  if (::geteuid() != 0) return;
  const bool made = ::mkdir(kFolder, 0700) == 0 || errno == EEXIST;
  for (int slot = 0; made && slot < kSlots; ++slot) {
    const std::string file = fmt::format("{}/{}", kFolder, slot);
    lock_ = ::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0600);
    if (lock_ < 0) break;
    if (::flock(lock_, LOCK_EX | LOCK_NB) == 0) {
      user_ = kFirst + static_cast<unsigned>(slot);
      return;
    }
    ::close(lock_);
  }
  throw Error(
      {.what = fmt::format("no free user ID for the sandbox in {}", kFolder), .found = std::strerror(errno)});
}

UserSlot::~UserSlot() {
  if (lock_ >= 0) ::close(lock_);
}

Cell::Cell(const Sandbox& sandbox, Confinement confinement)
    : sandbox_(sandbox), confinement_(std::move(confinement)) {
  confinement_.level = sandbox.level;
  if (!isConfined(sandbox.level)) return;
  slot_.emplace();
  confinement_.user = slot_->user();
  if (hasControlGroup(sandbox.level)) {
    constexpr int kOfTheSandbox = 3;
    group_.emplace(confinement_.addressSpace, confinement_.processes + kOfTheSandbox);
    confinement_.controlGroups = group_->processes();
  }
  const auto& folder = confinement_.writable;
  if (confinement_.user && !folder.empty() &&
      ::lchown(folder.c_str(), *confinement_.user, *confinement_.user) != 0)
    throw Error(
        {.what = "cannot give the work folder to the user of the sandbox", .found = std::strerror(errno)});
}

// The user ID will be lent to others.
Cell::~Cell() {
  const auto& folder = confinement_.writable;
  if (confinement_.user && !folder.empty())
    static_cast<void>(!::lchown(folder.c_str(), ::geteuid(), ::getegid()));
}

std::vector<std::string> Cell::command(const std::vector<std::string>& program) const {
  std::vector<std::string> command = {sandbox_.launcher.string()};
  const std::vector<std::string> arguments = toArguments(confinement_);
  command.insert(command.end(), arguments.begin(), arguments.end());
  command.insert(command.end(), program.begin(), program.end());
  return command;
}

void Cell::kill() const {
  if (group_) group_->kill();
}

}  // namespace rex::sandbox
