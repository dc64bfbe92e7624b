#include "grading/private_folder.h"

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <string>

#include "base/error.h"

namespace rex::grading {
namespace fs = std::filesystem;

PrivateFolder::PrivateFolder(const fs::path& parent) {
  std::string name = (parent / "rex-XXXXXX").string();
  if (::mkdtemp(name.data()) == nullptr)
    throw Error(
        {.what = "cannot make a temporary folder in " + parent.string(), .found = std::strerror(errno)});
  path_ = name;
}

PrivateFolder::~PrivateFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
  if (!fs::exists(fs::symlink_status(path_, ignored))) return;
  // Somebody took the permissions away. Folders made accessible on the way down can be listed.
  fs::permissions(path_, fs::perms::owner_all, ignored);
  for (fs::recursive_directory_iterator entry(path_, ignored), end; entry != end; entry.increment(ignored)) {
    if (entry->is_directory(ignored) && !entry->is_symlink(ignored))
      fs::permissions(entry->path(), fs::perms::owner_all, ignored);
  }
  fs::remove_all(path_, ignored);
}

}  // namespace rex::grading
