#include <algorithm>
#include <optional>

#include <fmt/format.h>

#include "formats/assets_internal.h"
#include "formats/mjcf_files_internal.h"
#include "formats/mjcf_parts_internal.h"
#include "formats/scene_file.h"
#include "formats/urdf_parts_internal.h"

namespace rex::mjcf {
namespace {

constexpr std::size_t kDeepestClass = 16;
constexpr std::size_t kMostGuesses = 1000;  // names among which a message looks for near ones
constexpr const char* kMainClass = "main";

struct KindOfTag {
  Kind kind;
  const Known* known;
};

std::optional<KindOfTag> kindOf(const Tag& tag) {
  if (tag.name() == "joint") return KindOfTag{Kind::kJoint, &knownOf("joint")};
  if (tag.name() == "geom") return KindOfTag{Kind::kGeom, &knownOf("geom")};
  if (tag.name() == "mesh") return KindOfTag{Kind::kMesh, &knownOf("mesh")};
  if (tag.name() == "material") return KindOfTag{Kind::kMaterial, &knownOf("material")};
  if (tag.name() == "equality") return KindOfTag{Kind::kEquality, &knownOf("equality/joint")};
  if (tag.name() == "tendon") return KindOfTag{Kind::kTendon, &knownOf("spatial")};
  const std::vector<std::string>& actuators = knownOf("actuator").children;
  const bool isActuator = std::ranges::find(actuators, tag.name()) != actuators.end();
  if (isActuator) return KindOfTag{Kind::kActuator, &knownOf("motor")};
  return {};
}

[[noreturn]] void failAtSecond(const Tag& tag) {
  tag.fail(tag.where("class"), "a second class of this name", xml::quoted(tag.text("class")),
           "a name of its own");
}

}  // namespace

template <class Gives>
const Tag* Styled::find(const Gives& gives) const {
  if (gives(own_)) return &own_;
  for (const DefaultClass* at = style_; at != nullptr; at = at->parent) {
    const std::vector<Tag>& tags = at->tags[static_cast<std::size_t>(kind_)];
    const auto last = std::find_if(tags.rbegin(), tags.rend(), gives);
    if (last != tags.rend()) return &*last;
  }
  return nullptr;
}

const Tag& Styled::giver(const char* attribute) const {
  const Tag* const found = find([&](const Tag& tag) { return tag.has(attribute); });
  return found ? *found : own_;
}

const Tag* Styled::giverOfText(const char* attribute) const {
  return find([&](const Tag& tag) {
    if (!tag.has(attribute)) return false;
    const std::string& text = tag.text(attribute);
    if (text.find_first_not_of(" \t\r\n") != text.npos) return true;
    tag.forgiveAt(attribute, "nothing", "numbers", "it counts as not given");
    return false;
  });
}

Defaults::Defaults() : main_(&classes_.emplace_back()) { byName_.emplace(kMainClass, main_); }

// What later sections add to the main class does not affect classes defined before them.
void Defaults::read(const Tag& tag, Files& files) {
  DefaultClass& own = classes_.emplace_back(DefaultClass{main_});
  const std::string name = tag.has("class") ? tag.nameIn("class") : kMainClass;
  const auto same = byName_.find(name);
  if (same != byName_.end() && same->second != main_) failAtSecond(tag);
  byName_[name] = byName_[kMainClass] = main_ = &own;
  fill(tag.of(fmt::format("default '{}'", name)), own, ++tops_, files);
}

void Defaults::fill(const Tag& tag, DefaultClass& own, std::size_t depth, Files& files) {
  if (depth > kDeepestClass)
    tag.fail(tag.where(), "classes nested too deep", fmt::format("level {}", depth),
             fmt::format("at most {}", kDeepestClass));
  std::vector<Tag> nested;
  for (const Tag& child : files.children(tag, knownOf("default"))) {
    if (child.name() == "default") nested.push_back(child);
    const std::optional<KindOfTag> kind = kindOf(child);
    if (!kind) continue;
    child.expect(*kind->known);
    own.tags[static_cast<std::size_t>(kind->kind)].push_back(child);
  }
  for (const Tag& inner : nested) {
    const std::string& name = inner.nameIn("class");
    DefaultClass& innerClass = classes_.emplace_back(DefaultClass{&own});
    if (!byName_.emplace(name, &innerClass).second) failAtSecond(inner);
    fill(inner.of(fmt::format("default '{}'", name)), innerClass, depth + 1, files);
  }
}

const DefaultClass& Defaults::named(const Tag& tag, const char* attribute,
                                    const DefaultClass& otherwise) const {
  if (!tag.has(attribute)) return otherwise;
  const std::string& name = tag.text(attribute);
  if (const auto found = byName_.find(name); found != byName_.end()) return *found->second;
  std::vector<std::string> known;
  for (const auto& [other, unused] : byName_) known.push_back(other);
  std::sort(known.begin(), known.end());
  known.resize(std::min(known.size(), kMostGuesses));
  tag.fail(tag.where(attribute), fmt::format("attribute '{}'", attribute), xml::quoted(name),
           "the class of a <default>", nearestNames(name, known));
}

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
    Known& knownOfRoot = knownOfRoots_.emplace_back(known);
    knownOfRoot.attributes = {"model"};
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
