#include "sandbox/bubblewrap.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <system_error>

#include <sys/mman.h>
#include <sys/random.h>
#include <unistd.h>

#include "base/error.h"
#include "base/folders.h"
#include "sandbox/system_files_internal.h"

namespace rex::sandbox {
namespace {

namespace fs = std::filesystem;

void addAllBut(const fs::path& place, const std::vector<fs::path>& hidden, std::vector<fs::path>& found) {
  std::error_code failed;
  const fs::path real = fs::canonical(place, failed);
  if (failed) return;
  const auto isHidden = [&](const fs::path& one) { return isBelow(one, real); };
  const auto hides = [&](const fs::path& one) { return isBelow(real, one); };
  if (std::any_of(hidden.begin(), hidden.end(), isHidden)) return;
  if (std::none_of(hidden.begin(), hidden.end(), hides)) {
    found.push_back(place);
  } else if (real == place) {
    for (const auto& entry : fs::directory_iterator(place, failed)) addAllBut(entry.path(), hidden, found);
  }
}

}  // namespace

std::vector<fs::path> hiddenFolders(const fs::path& launcher) {
  std::vector<fs::path> hidden;
  const fs::path own = launcher.parent_path();
  for (const fs::path& folder : {own, own / "home"}) {
    std::error_code missing;
    const fs::path real = fs::canonical(folder, missing);
    if (!missing && isBelow("/usr", real)) hidden.push_back(real);
  }
  return hidden;
}

std::vector<fs::path> allBut(const fs::path& folder, const std::vector<fs::path>& hidden) {
  std::vector<fs::path> found;
  addAllBut(folder, hidden, found);
  return found;
}

namespace {

// The second is for machines with short addresses; the sanitizers keep all that is below it for themselves.
constexpr std::uint64_t kHighest[] = {std::uint64_t{1} << 46, std::uint64_t{1} << 38};
constexpr std::size_t kPage = 65536, kStep = 16;  // for all kinds of machines

// That many bytes at a random address, which may be anywhere within its page.
void* randomPlace(std::size_t size) {
  for (int attempt = 0; attempt < 100; ++attempt) {
    std::uint64_t random = 0;
    if (::getrandom(&random, sizeof random, 0) != sizeof random) break;
    const std::uint64_t address = random % kHighest[attempt % 2] / kStep * kStep,
                        page = address / kPage * kPage;
    if (page == 0) continue;
    const std::size_t length = (address - page + size + kPage - 1) / kPage * kPage;
    void* place = ::mmap(reinterpret_cast<void*>(page), length, PROT_READ | PROT_WRITE,
                         MAP_PRIVATE | MAP_ANONYMOUS | MAP_FIXED_NOREPLACE, -1, 0);
    if (place == MAP_FAILED) continue;
    if (place == reinterpret_cast<void*>(page)) return reinterpret_cast<void*>(address);
    ::munmap(place, length);
  }
  throw Error({.what = "no room in memory for the arguments of a program", .found = std::strerror(errno)});
}

}  // namespace

const char* hiddenWord(const std::string& word) {
  return static_cast<char*>(std::memcpy(randomPlace(word.size() + 1), word.c_str(), word.size() + 1));
}

char* const* hiddenWords(const std::vector<std::string>& words) {
  auto** list = static_cast<char**>(randomPlace((words.size() + 1) * sizeof(char*)));
  for (std::size_t k = 0; k < words.size(); ++k) list[k] = const_cast<char*>(hiddenWord(words[k]));
  list[words.size()] = nullptr;
  return list;
}

namespace {

constexpr const char* kMemoryFolderBytes = "33554432";      // 32 MB
constexpr const char* kCompilersFolderBytes = "268435456";  // 256 MB: assembler text of a large file

using Options = std::vector<std::string>;

void add(Options& options, std::initializer_list<std::string> more) { options.insert(options.end(), more); }

void addNamespaces(Options& options, bool becomesUser) {
  add(options, {"--unshare-ipc", "--unshare-pid", "--unshare-net", "--unshare-uts", "--unshare-cgroup-try",
                "--as-pid-1", "--die-with-parent", "--new-session", "--clearenv", "--hostname", "box",
                "--cap-drop", "ALL"});
  if (becomesUser)
    add(options, {"--cap-add", "CAP_SETUID", "--cap-add", "CAP_SETGID", "--cap-add", "CAP_KILL"});
  else
    add(options, {"--unshare-user", "--disable-userns"});
}

// Folders that bubblewrap makes by itself are accessible only to their owner.
void addParents(Options& options, const std::filesystem::path& place) {
  std::filesystem::path folder = "/";
  for (const auto& name : place.parent_path().relative_path()) {
    folder /= name;
    add(options, {"--perms", "0755", "--dir", folder.string()});
  }
}

void show(Options& options, const char* how, const std::filesystem::path& path,
          const std::filesystem::path& inside) {
  addParents(options, inside);
  add(options, {how, path.string(), inside.string()});
}

// The system's programs and libraries, harmless devices and the sandbox's own processes, all read-only.
void addSystem(Options& options, bool compiles, const std::vector<std::filesystem::path>& hidden) {
  add(options, {"--ro-bind", "/usr", "/usr"});
  for (const auto& folder : hidden)
    add(options, {"--perms", "0755", "--size", "4194304", "--tmpfs", folder.string()});
  for (const char* name : kRootFolders) {
    const std::filesystem::path folder(name);
    if (std::filesystem::is_symlink(folder))
      add(options, {"--symlink", std::filesystem::read_symlink(folder).string(), name});
    else
      add(options, {"--ro-bind-try", name, name});
  }
  for (const char* name : kSystemFiles) show(options, "--ro-bind-try", name, name);
  add(options, {"--proc", "/proc", "--size", "4096", "--tmpfs", "/dev"});
  for (const char* device : kDevices) add(options, {"--dev-bind-try", device, device});
  if (!compiles)
    for (const char* device : kEndlessDevices) add(options, {"--dev-bind-try", device, device});
  add(options, {"--symlink", "/proc/self/fd", "/dev/fd", "--remount-ro", "/dev"});
}

}  // namespace

std::vector<std::string> bubblewrapOptions(const Confinement& confinement,
                                           const std::filesystem::path& launcher) {
  Options options;
  addNamespaces(options, confinement.user.has_value());
  const bool compiles = confinement.mayStartProgramsOfItsOwn;
  const std::vector<std::filesystem::path> hidden = hiddenFolders(launcher);
  addSystem(options, compiles, hidden);
  add(options, {"--perms", "1777", "--size", compiles ? kCompilersFolderBytes : kMemoryFolderBytes, "--tmpfs",
                kInsideFolder});
  for (const Readable& readable : confinement.readable)
    show(options, "--ro-bind", readable.path, readable.inside);
  if (!confinement.writable.empty()) show(options, "--bind", confinement.writable, confinement.writable);
  show(options, "--ro-bind", launcher, kInsideLauncher);
  for (const auto& folder : hidden) add(options, {"--remount-ro", folder.string()});
  add(options, {"--remount-ro", "/", "--chdir", "/"});
  return options;
}

std::string insidePath(const Confinement& confinement, const std::string& path) {
  for (const Readable& readable : confinement.readable)
    if (readable.path == path) return readable.inside.string();
  return path;
}

}  // namespace rex::sandbox
