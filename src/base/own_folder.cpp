#include "base/own_folder.h"

#include <cassert>

#include <dlfcn.h>

#include "base/is_below.h"

namespace rex {
namespace {

namespace fs = std::filesystem;

// Without links, as a program may be started through one. In the folder of a killed build, whose libraries
// are gone, the path stays as it is.
fs::path withoutLinks(const fs::path& path) {
  std::error_code missing;
  const fs::path real = fs::weakly_canonical(path, missing);
  return missing ? path : real;
}

fs::path folderOfThisLibrary() {
  Dl_info place{};
  const int known = ::dladdr(reinterpret_cast<const void*>(&folderOfThisLibrary), &place);
  assert(known != 0 && place.dli_fname != nullptr);  // this function is in a library or program
  static_cast<void>(known);
  return withoutLinks(place.dli_fname).parent_path();
}

}  // namespace

const fs::path& ownFolder() {
  static const fs::path folder = folderOfThisLibrary().parent_path();
  return folder;
}

const fs::path& homeFolder() {
  static const fs::path folder = withoutLinks(ownFolder() / "home");
  return folder;
}

bool isInstalled() { return !fs::exists(ownFolder() / "build.ninja"); }

bool isOwnFile(const fs::path& path) { return isBelow(ownFolder(), path) || isBelow(homeFolder(), path); }

}  // namespace rex
