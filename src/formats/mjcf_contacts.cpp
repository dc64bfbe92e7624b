#include <algorithm>

#include <fmt/format.h>

#include "formats/mjcf_parts_internal.h"

namespace rex::mjcf {
namespace {

// What the shapes in contact of a body offer together.
struct Touch {
  std::uint32_t type = 0, affinity = 0;
  std::vector<int> pairs{};

  bool isEmpty() const { return type == 0 && affinity == 0 && pairs.empty(); }
};

Touch touchOf(const std::vector<ShapeSpec>& shapes) {
  Touch all;
  for (const ShapeSpec& shape : shapes) {
    if (!shape.contact) continue;
    all.type |= shape.mask.type;
    all.affinity |= shape.mask.affinity;
    all.pairs.insert(all.pairs.end(), shape.mask.pairs.begin(), shape.mask.pairs.end());
  }
  return all;
}

// That of the shape that a fitted geom will be: until then it is out of contact.
Touch touchOf(const BodyTree& tree, const BodyInFile& one) {
  Touch all = touchOf(tree.spec.bodies[one.body].shapes);
  for (const FitInTree& fit : tree.fits) {
    if (!fit.fit.contact || fit.at.body != one.body) continue;
    const ContactMask& mask = tree.spec.bodies[one.body].shapes[fit.at.first].mask;
    all.type |= mask.type;
    all.affinity |= mask.affinity;
    all.pairs.insert(all.pairs.end(), mask.pairs.begin(), mask.pairs.end());
  }
  return all;
}

bool mayTouch(const Touch& a, const Touch& b) {
  return rex::mayTouch({a.type, a.affinity, a.pairs}, {b.type, b.affinity, b.pairs});
}

// The bodies with shapes in contact, in the order of the file, and the world last.
std::vector<std::string> touchable(const BodyTree& tree) {
  std::vector<std::string> names;
  for (const BodyInFile& one : tree.bodies)
    if (!touchOf(tree, one).isEmpty()) names.push_back(tree.spec.bodies[one.body].name);
  if (!touchOf(tree.spec.worldShapes).isEmpty()) names.emplace_back(kWorldName);
  return names;
}

// For each body, the one that carries the rigid group it belongs to: the world if the group is fixed.
std::unordered_map<std::string, std::string> carriers(const BodyTree& tree) {
  std::unordered_map<std::string, std::string> carrierOf = {{kWorldName, kWorldName}};
  for (const BodyInFile& one : tree.bodies) {
    const std::string& name = tree.spec.bodies[one.body].name;
    carrierOf[name] = one.joints > 0 ? name : carrierOf.at(one.parent);
  }
  return carrierOf;
}

// Warns of bodies, with the names of some.
void warnOf(const std::vector<const BodySpec*>& bodies, const char* what, const char* why, Notes& notes) {
  constexpr std::size_t kMostNamed = 5;
  if (bodies.empty()) return;
  std::string names;
  for (std::size_t i = 0; i < std::min(bodies.size(), kMostNamed); ++i)
    names += fmt::format("{}'{}'", i == 0 ? "" : ", ", bodies[i]->name);
  if (bodies.size() > kMostNamed) names += fmt::format(" and {} more", bodies.size() - kMostNamed);
  notes.warn(bodies.front()->where, fmt::format("{} {}: {}", what, names, why));
}

// The geom that an attribute names.
const GeomInTree& geomIn(const Tag& tag, const char* attribute, const BodyTree& tree) {
  const std::string name = tree.seen(tag.nameIn(attribute), tree.geomOfName);
  if (const auto found = tree.geomOfName.find(name); found != tree.geomOfName.end()) return found->second;
  std::vector<std::string> known;
  for (const auto& [other, unused] : tree.geomOfName) known.push_back(other);
  std::sort(known.begin(), known.end());
  tag.fail(tag.where(attribute), "unknown geom", xml::quoted(name), "the name of a <geom>",
           nearestNames(name, known));
}

// <pair>: shapes of the same number may touch, and take part in contacts for that.
void readPair(const Tag& tag, int number, BodyTree& tree) {
  tag.expect(knownOf("pair"));
  const GeomInTree ends[] = {geomIn(tag, "geom1", tree), geomIn(tag, "geom2", tree)};
  for (const GeomInTree& end : ends)
    if (end.count == 0)
      return tag.remark("a <pair> of a geom that is ignored is ignored, too", Difference::kContact);
  for (const GeomInTree& end : ends) {
    std::vector<ShapeSpec>& shapes = tree.shapesOf(end.body);
    for (std::size_t i = end.first; i < end.first + end.count; ++i) {
      // Of a height field, one shape is only drawn.
      if (end.count > 1 && i == end.first) continue;
      shapes[i].mask.pairs.push_back(number);
      shapes[i].contact = true;
    }
    for (FitInTree& fit : tree.fits) {
      if (fit.at.body != end.body || fit.at.first != end.first) continue;
      fit.fit.contact = true;
      shapes[end.first].contact = false;
    }
  }
}

}  // namespace

void readContacts(const std::vector<Tag>& sections, Files& files, BodyTree& tree) {
  constexpr int kMostPairs = 4096;
  int pairs = 0;
  const auto addPair = [&](const Tag& tag) {
    if (pairs == kMostPairs)
      tag.fail(tag.where(), "too many <pair>", "", fmt::format("at most {}", kMostPairs));
    readPair(tag, pairs++, tree);
  };
  const auto exclude = [&](const Tag& tag) {
    tag.expect(knownOf("exclude"));
    const std::string a = bodyIn(tag, "body1", tree), b = bodyIn(tag, "body2", tree);
    if (a == b) tag.fail(tag.where("body2"), "one body", xml::quoted(b), "two bodies");
    tree.spec.collisionChoices.push_back({a, b, false, "exclude", tag.where()});
  };
  for (const Tag& section : sections)
    for (const Tag& tag : files.children(section.of("<contact>"), knownOf("contact")))
      tree.forEachReplica(tag, [&] { tag.name() == "pair" ? addPair(tag) : exclude(tag); });
}

void noteUntouchable(BodyTree& tree, Notes& notes) {
  std::vector<Touch> touches;
  for (const BodyInFile& one : tree.bodies) touches.push_back(touchOf(tree, one));
  const Touch world = touchOf(tree.spec.worldShapes), added{1, 1};
  std::vector<const BodySpec*> byNothing, byNothingAdded;
  for (std::size_t i = 0; i < touches.size(); ++i) {
    if (!tree.bodies[i].hasGeoms || mayTouch(touches[i], added)) continue;
    bool touchesAny = mayTouch(touches[i], world);
    for (std::size_t k = 0; k < touches.size() && !touchesAny; ++k)
      touchesAny = k != i && mayTouch(touches[i], touches[k]);
    (touchesAny ? byNothingAdded : byNothing).push_back(&tree.spec.bodies[tree.bodies[i].body]);
  }
  warnOf(byNothing, "nothing can touch", "no geom of theirs has a bit of contype or conaffinity to share",
         notes);
  warnOf(byNothingAdded, "what is added to the scene, such as a floor or obstacles, cannot touch",
         "it has contype 1 and conaffinity 1", notes);
}

void forbidNeighbours(BodyTree& tree) {
  const std::unordered_map<std::string, std::string> carrierOf = carriers(tree);
  std::unordered_map<std::string, std::vector<std::string>> carried;
  for (const std::string& name : touchable(tree)) carried[carrierOf.at(name)].push_back(name);
  for (const BodyInFile& one : tree.bodies) {
    const std::string& name = tree.spec.bodies[one.body].name;
    const std::string& parent = carrierOf.at(one.parent);
    if (one.joints < 2 || parent == kWorldName) continue;
    for (const std::string& a : carried[parent])
      for (const std::string& b : carried[name])
        tree.spec.collisionChoices.push_back({a, b, false, "Adjacent", {}});
  }
}

}  // namespace rex::mjcf
