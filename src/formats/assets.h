#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "base/error.h"

namespace rex {

/// Whether a file name has the form package:///PATH, without a package.
[[nodiscard]] bool namesNoPackage(std::string_view file);

/// The files that a scene may name: only those inside its asset root after links are resolved, and, unless
/// the root is given, those of packages above it.
class Assets {
 public:
  /// For the scene in `sceneFile`. The default `root` is the parent of the scene's folder, so that a scene
  /// finds meshes in sibling folders. With `needsNoPackage`, package:///PATH is looked up in the folders
  /// above the scene. Throws Error if the given `root` is not a folder.
  explicit Assets(const std::filesystem::path& sceneFile, const std::filesystem::path& root = {},
                  bool needsNoPackage = false);

  /// The folder of the scene, to which relative names refer.
  const std::filesystem::path& folder() const { return folder_; }
  /// The folder that holds all files.
  const std::filesystem::path& root() const { return root_; }

  /// The location of `name`, without links. `name` is a path relative to folder(), or
  /// package://PACKAGE/PATH, which is looked up in folders called PACKAGE above and beside the scene, then
  /// in the root; with the default root also in folders called PACKAGE above it, if exactly one has the file.
  /// Throws Error at `where`, beginning with `what`, for a network address, a path that leaves the root, a
  /// file that cannot be read, and a missing file, with all paths tried, or the roots that have it.
  [[nodiscard]] std::filesystem::path find(const std::string& name, const SourceLocation& where,
                                           const std::string& what) const;

 private:
  std::filesystem::path folder_, root_;
  bool hasUsualRoot_, needsNoPackage_;
};

/// The file that a user means by `scene`: a path, or a scene of the course in the folder `library`, with or
/// without its extension: robots/NAME.ors, robots/NAME/NAME.urdf or scenes/NAME.ors. A file at that path
/// comes first. Throws Error with the nearest names if there is none.
[[nodiscard]] std::filesystem::path findScene(const std::filesystem::path& scene,
                                              const std::filesystem::path& library);

}  // namespace rex
