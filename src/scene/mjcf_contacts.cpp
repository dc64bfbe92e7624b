#include <algorithm>

#include <fmt/format.h>

#include "scene/mjcf_parts_internal.h"

namespace rex::mjcf {
namespace {

bool mayTouch(const Touch& a, const Touch& b) {
  return (a.contype & b.conaffinity) != 0 || (b.contype & a.conaffinity) != 0;
}

// The bodies with shapes in contact, in the order of the file, and the world last.
std::vector<std::string> touchable(const BodyTree& tree) {
  std::vector<std::string> names;
  for (const BodyInFile& one : tree.bodies)
    if (const std::string& name = tree.spec.bodies[one.body].name; tree.touches.contains(name))
      names.push_back(name);
  if (tree.touches.contains(kWorldName)) names.emplace_back(kWorldName);
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

}  // namespace

void chooseByBits(BodyTree& tree) {
  const std::vector<std::string> names = touchable(tree);
  std::unordered_map<std::string, bool> isAlone;
  for (const std::string& a : names)
    isAlone[a] = std::none_of(names.begin(), names.end(), [&](const std::string& b) {
      return a != b && mayTouch(tree.touches.at(a), tree.touches.at(b));
    });
  const auto choose = [&](const std::string& a, const std::string& b) {
    tree.spec.collisionChoices.push_back({a, b, false, "contype and conaffinity", {}});
  };
  for (auto a = names.begin(); a != names.end(); ++a) {
    if (isAlone[*a] && names.size() > 1) choose(*a, "");
    for (auto b = a + 1; b != names.end(); ++b)
      if (!isAlone[*a] && !isAlone[*b] && !mayTouch(tree.touches.at(*a), tree.touches.at(*b))) choose(*a, *b);
  }
}

void chooseNeighbours(BodyTree& tree) {
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
