#include <algorithm>

#include <fmt/format.h>

#include "scene/files_internal.h"
#include "scene/mjcf_files_internal.h"
#include "scene/scene_file.h"
#include "scene/urdf_parts_internal.h"

namespace rex::mjcf {
namespace {

constexpr std::size_t kLargestFile = 8u << 20, kMostBytesTogether = 32u << 20, kMostFiles = 64;

void requireRoot(const xml::Document& document, const std::vector<std::string>& roots) {
  const std::string& name = document.root.name;
  if (std::find(roots.begin(), roots.end(), name) != roots.end()) return;
  throw Error({.what = "not an MJCF model",
               .where = document.where(document.root.at),
               .found = fmt::format("<{}>", name),
               .wanted = name == "robot" ? "<mujoco>; if it is a robot in URDF, name it .urdf" : "<mujoco>",
               .nearest = nearestNames(name, roots)});
}

}  // namespace

Files::File::File(std::string ownText, std::string_view given, const std::string& name, bool strict)
    : text(std::move(ownText)),
      document(xml::parse(given.data() ? given : text, name, !strict, "<mujoco ...>")),
      reading{document, strict} {
  urdf::noteSkippedBlanks(reading);
}

Files::Files(std::string_view text, const std::string& name, const Assets* assets, bool strict)
    : assets_(assets), strict_(strict), bytes_(text.size()) {
  files_.emplace_back("", text.data() ? text : std::string_view(""), name, strict);
  if (assets) paths_.insert(internal::realPath(name).string());
}

Tag Files::root() {
  requireRoot(main().document, {"mujoco"});
  return Tag(main(), main().document.root, "<mujoco>");
}

std::vector<Tag> Files::children(const Tag& tag, const Known& known) {
  std::vector<Tag> children;
  append(tag, known, children);
  return children;
}

void Files::append(const Tag& tag, const Known& known, std::vector<Tag>& children) {
  tag.expect(known);
  for (const Tag& child : tag.children()) {
    if (child.name() != "include") {
      children.push_back(child);
      continue;
    }
    File& file = open(child);
    const Known& knownOfRoot =
        knownOfRoots_.emplace_back(Known{{"model"}, known.children, known.ignoredChildren});
    append(Tag(file.reading, file.document.root, tag.thing()), knownOfRoot, children);
  }
}

Files::File& Files::open(const Tag& include) {
  static const Known kKnown = {{"file"}, {}};
  include.expect(kKnown);
  const std::string& name = include.nameIn("file");
  const auto fail = [&](std::string found, std::string wanted) {
    include.failAt("file", std::move(found), std::move(wanted));
  };
  if (!assets_) fail("a scene that was given as text", "no <include>: only models in files include others");
  const std::filesystem::path path =
      assets_->find(name, include.where("file"), fmt::format("<include> of '{}'", name));
  if (!paths_.insert(internal::realPath(path).string()).second)
    fail("a file that is already included", "each file once");
  if (files_.size() >= kMostFiles)
    fail(fmt::format("file number {}", files_.size() + 1), fmt::format("at most {}", kMostFiles));
  std::string text = readSceneText(path, kLargestFile);
  bytes_ += text.size();
  if (bytes_ > kMostBytesTogether)
    fail(fmt::format("{} bytes in all files", bytes_),
         fmt::format("at most {} MiB", kMostBytesTogether >> 20));
  File& file = files_.emplace_back(std::move(text), std::string_view{}, path.string(), strict_);
  requireRoot(file.document, {"mujoco", "mujocoinclude"});
  return file;
}

std::filesystem::path Files::find(const std::string& name, const Tag& tag) const {
  return assets_->find(name, tag.where("file"), fmt::format("<{}> '{}'", tag.name(), name));
}

Diagnostics Files::takeNotes() {
  for (auto file = files_.begin() + 1; file != files_.end(); ++file)
    main().notes.add(std::move(file->reading.notes));
  while (files_.size() > 1) files_.pop_back();
  return main().notes.take();
}

}  // namespace rex::mjcf
