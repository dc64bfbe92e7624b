#include "sandbox/bubblewrap.h"

#include <array>

#include <unistd.h>

#include "sandbox/hidden_folders.h"
#include "sandbox/system_files_internal.h"

namespace rex::sandbox {
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
