#include <algorithm>

#include <fmt/format.h>

#include "scene/files_internal.h"
#include "scene/ors_files_internal.h"
#include "scene/ors_limits_internal.h"
#include "scene/scene_file.h"

namespace rex::ors {

namespace fs = std::filesystem;

Files::Files(const Assets* assets, const std::string& file, std::size_t bytes)
    : assets_(assets), bytes_(bytes) {
  if (bytes > kMostBytes) {
    throw Error({.what = "scene too large",
                 .where = {file},
                 .found = fmt::format("{} bytes", bytes),
                 .wanted = fmt::format("at most {} MiB", kMostBytes >> 20)});
  }
  if (assets) open_.push_back(fs::weakly_canonical(file));
}

Files::Opened Files::open(const FileName& file, const Place& where) {
  const std::string what = fmt::format("Include '{}'", file.path);
  const auto fail = [&](std::string found, std::string wanted) {
    throw Error({.what = what, .where = where, .found = std::move(found), .wanted = std::move(wanted)});
  };
  if (!assets_) fail("a scene that was given as text", "no Include: only scenes in files include others");
  const fs::path path = assets_->find(file.path, where, what);
  if (open_.size() > kDeepestIncludes)
    fail(fmt::format("level {}", open_.size()), fmt::format("at most {}", kDeepestIncludes));
  const fs::path real = fs::weakly_canonical(path);
  if (std::find(open_.begin(), open_.end(), real) != open_.end())
    fail("a file that includes itself", "another file");
  const fs::path folder =
      isAddress(file.path)
          ? internal::folderOf(path).lexically_relative(internal::realPath(assets_->folder()))
          : fs::path(file.path).parent_path();
  Opened opened{path.string(), readSceneText(path), folder};
  bytes_ += opened.text.size();
  if (bytes_ > kMostBytes)
    fail(fmt::format("{} bytes in all", bytes_), fmt::format("at most {} MiB", kMostBytes >> 20));
  open_.push_back(real);
  return opened;
}

bool Files::hasFolder(const std::string& folder) const {
  std::error_code problem;
  return !assets_ || isAddress(folder) || fs::is_directory(open_.front().parent_path() / folder, problem);
}

bool isAddress(const std::string& name) { return name.find("://") != std::string::npos; }

std::string inFolder(const std::string& folder, const std::string& name) {
  const bool isComplete = name.starts_with('/') || isAddress(name);
  return folder.empty() || isComplete ? name : folder + (folder.ends_with('/') ? "" : "/") + name;
}

}  // namespace rex::ors
