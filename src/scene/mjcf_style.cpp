#include <algorithm>
#include <optional>

#include <fmt/format.h>

#include "scene/mjcf_parts_internal.h"
#include "scene/mjcf_style_internal.h"

namespace rex::mjcf {
namespace {

constexpr std::size_t kDeepestClass = 16;
constexpr std::size_t kMostGuesses = 1000;  // names among which a message looks for near ones
constexpr const char* kMainClass = "main";

const Known& knownOfDefault() {
  static const Known kKnown = {
      {"class"},
      {"include", "default", "joint", "geom", "mesh", "material", "equality", "general", "motor", "position",
       "velocity", "intvelocity", "damper", "cylinder"},
      {"site", "camera", "light", "pair", "tendon", "muscle", "adhesion", "plugin"}};
  return kKnown;
}

struct KindOfTag {
  Kind kind;
  const Known* known;
};

std::optional<KindOfTag> kindOf(const Tag& tag) {
  if (tag.name() == "joint") return KindOfTag{Kind::kJoint, &knownOfJoint()};
  if (tag.name() == "geom") return KindOfTag{Kind::kGeom, &knownOfGeom()};
  if (tag.name() == "mesh") return KindOfTag{Kind::kMesh, &knownOfMesh()};
  if (tag.name() == "material") return KindOfTag{Kind::kMaterial, &knownOfMaterial()};
  if (tag.name() == "equality") return KindOfTag{Kind::kEquality, &knownOfEquality()};
  const std::vector<std::string>& known = knownOfDefault().children;
  const bool isActuator = std::find(known.begin() + 2, known.end(), tag.name()) != known.end();
  if (isActuator) return KindOfTag{Kind::kActuator, &knownOfActuator()};
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
  for (const Tag& child : files.children(tag, knownOfDefault())) {
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

}  // namespace rex::mjcf
