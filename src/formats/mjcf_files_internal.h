#pragma once

#include <array>
#include <deque>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "formats/assets.h"
#include "formats/urdf_tag_internal.h"

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
  /// Which files may be read. Only if files may be.
  const Assets& assets() const { return *assets_; }
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

/// The kinds of tags that have defaults which are read; all actuators share theirs.
enum class Kind { kJoint, kGeom, kMesh, kMaterial, kActuator, kEquality, kTendon };
inline constexpr std::size_t kKinds = 7;

/// A <default> with the tags that it gives, in the order of the file.
struct DefaultClass {
  const DefaultClass* parent = nullptr;
  std::array<std::vector<Tag>, kKinds> tags{};
};

/// A tag, together with the defaults of its class.
class Styled {
 public:
  explicit Styled(Tag own) : own_(std::move(own)) {}
  Styled(Tag own, const DefaultClass& style, Kind kind) : own_(std::move(own)), style_(&style), kind_(kind) {}

  const Tag& own() const { return own_; }
  /// The tag that gives an attribute: this one, or the nearest default; this one too if none does.
  const Tag& giver(const char* attribute) const;
  /// The tag that gives an attribute which counts as not given where it is blank, as MuJoCo has it; each
  /// blank one is a warning or, if the reading is strict, an Error. Null if none does.
  const Tag* giverOfText(const char* attribute) const;
  bool has(const char* attribute) const { return giver(attribute).has(attribute); }
  double number(const char* attribute, double otherwise) const {
    return giver(attribute).number(attribute, otherwise);
  }

 private:
  template <class Gives>
  const Tag* find(const Gives& gives) const;

  Tag own_;
  const DefaultClass* style_ = nullptr;
  Kind kind_{};
};

/// All classes of defaults by their names.
class Defaults {
 public:
  Defaults();
  /// Adds a <default> at the top of the model. Throws Error for a class without a name within another, two of
  /// one name, and classes nested deeper than 16.
  void read(const Tag& tag, Files& files);

  const DefaultClass& main() const { return *main_; }
  /// The class that an attribute names, `otherwise` without it. Throws Error for an unknown one.
  const DefaultClass& named(const Tag& tag, const char* attribute, const DefaultClass& otherwise) const;

 private:
  void fill(const Tag& tag, DefaultClass& own, std::size_t depth, Files& files);

  std::deque<DefaultClass> classes_;
  const DefaultClass* main_;
  std::size_t tops_ = 0;
  std::unordered_map<std::string, const DefaultClass*> byName_;
};

}  // namespace rex::mjcf
