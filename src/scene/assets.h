#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "base/error.h"

namespace rex {

/// Whether a file is named as package:///PATH, without a package.
[[nodiscard]] bool namesNoPackage(std::string_view file);

/// The files that a scene may name: only those inside its asset root, links followed.
class Assets {
 public:
  /// For the scene in `sceneFile`. Without a `root` it is the folder above that of the scene, so that a scene
  /// reaches the meshes beside its own folder. With `needsNoPackage`, package:///PATH is looked up in the
  /// folders above the scene. Throws Error if a `root` is given that is not a folder.
  explicit Assets(const std::filesystem::path& sceneFile, const std::filesystem::path& root = {},
                  bool needsNoPackage = false);

  /// The folder of the scene, to which relative names refer.
  const std::filesystem::path& folder() const { return folder_; }
  /// The folder that holds all files.
  const std::filesystem::path& root() const { return root_; }

  /// Where `name` lies, without links: a path relative to folder(), or package://PACKAGE/PATH, which is
  /// looked up in folders called PACKAGE above and beside the scene, then in the root. Throws Error at
  /// `where`, beginning with `what`: an address on the network, a path out of the root, no file that can be
  /// read, or no such file, with all paths tried.
  [[nodiscard]] std::filesystem::path find(const std::string& name, const SourceLocation& where,
                                           const std::string& what) const;

 private:
  std::filesystem::path folder_, root_;
  bool needsNoPackage_;
};

}  // namespace rex
