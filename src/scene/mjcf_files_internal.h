#pragma once

#include <deque>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "scene/assets.h"
#include "scene/urdf_tag_internal.h"

namespace rex::mjcf {

using urdf::Known;
using urdf::Notes;
using urdf::Reading;
using urdf::Tag;

/// The file of a model, and those that it includes.
class Files {
 public:
  /// Without `assets` no file is read, and an <include> is an Error. Throws Error for what is not MJCF.
  Files(std::string_view text, const std::string& name, const Assets* assets, bool strict);

  Tag root();
  /// What stands in a tag, in place of each <include> what its file holds. Notes all that is not `known`,
  /// which must outlive the tag and list "include". To be called once for each tag. Throws Error for a file
  /// that is not found, is included twice, or is one too many.
  std::vector<Tag> children(const Tag& tag, const Known& known);

  /// Whether files may be read.
  bool areRead() const { return assets_ != nullptr; }
  /// Where a file lies that a tag names, see Assets::find(). Only if files may be read.
  [[nodiscard]] std::filesystem::path find(const std::string& name, const Tag& tag) const;
  /// Where to note what concerns the whole model.
  Reading& main() { return files_.front().reading; }
  /// The notes of all files.
  [[nodiscard]] Diagnostics takeNotes();

 private:
  struct File {
    File(std::string ownText, std::string_view text, const std::string& name, bool strict);
    std::string text;
    xml::Document document;
    Reading reading;
  };
  File& open(const Tag& include);
  void append(const Tag& tag, const Known& known, std::vector<Tag>& children);

  const Assets* assets_;
  bool strict_;
  std::deque<File> files_;
  std::deque<Known> knownOfRoots_;  // of included files
  std::set<std::string> paths_;
  std::size_t bytes_;
};

}  // namespace rex::mjcf
