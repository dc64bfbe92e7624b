#include <algorithm>
#include <iterator>
#include <set>

#include <fmt/format.h>

#include "scene/ors_merger_internal.h"
#include "scene/ors_names_internal.h"
#include "scene/ors_node_list_internal.h"

namespace rex::ors {

bool isEdit(const Node& node) {
  return !node.keys.empty() && (node.keys[0].text == "Edit" || node.keys[0].text == "Merge");
}

void NodeList::add(Node node) {
  live_.push_back(nodes_.size());
  nodes_.push_back(std::move(node));
}

std::optional<int> NodeList::previous(std::size_t k) const {
  if (k == 0 || k > live_.size()) return std::nullopt;
  return nodes_[live_[live_.size() - k]].id;
}

// The name of a parent, also of one given by counting back; names of nameless joints consist of such names.
std::string NodeList::nameOf(const Word& parent) const {
  if (!parent.node) return parent.text;
  const auto meant = std::lower_bound(nodes_.begin(), nodes_.end(), *parent.node,
                                      [](const Node& node, int id) { return node.id < id; });
  return meant == nodes_.end() || meant->keys.empty() ? parent.text : meant->keys.back().text;
}

// What messages call a joint without a name; empty for anything else.
std::string NodeList::nameOfJoint(const Node& node) const {
  if (node.keys.size() != 1 || node.keys[0].text != "joint" || node.parents.size() != 2) return "";
  return nameOf(node.parents[0]) + ">" + nameOf(node.parents[1]);
}

// "(arm hand)". A valid statement has at most two; the names of as many as a file may list would take much
// memory.
std::string NodeList::parentsOf(const Node& node) const {
  std::string text;
  for (const Word& parent : node.parents)
    text += (text.empty() ? "(" : " ") + (node.parents.size() > 2 ? parent.text : nameOf(parent));
  return text.empty() ? "" : text + ")";
}

std::string NodeList::textOf(const Node& node) const {
  const std::string keys = joinedKeys(node), parents = parentsOf(node);
  return keys + (keys.empty() || parents.empty() ? "" : " ") + parents;
}

// Parents count as keys in brackets, which occur in no other key.
void NodeList::indexKeys() {
  const auto add = [&](const std::string& key) {
    std::vector<std::size_t>& having = havingKey_[key];
    if (having.empty() || having.back() != indexed_) having.push_back(indexed_);
  };
  for (; indexed_ < nodes_.size(); ++indexed_) {
    const Node& node = nodes_[indexed_];
    for (const Word& key : node.keys) add(key.text);
    if (!node.parents.empty()) add(parentsOf(node));
    if (const std::string name = nameOfJoint(node); !name.empty()) add(name);
  }
}

std::size_t NodeList::erase(const Node& named) {
  indexKeys();
  std::set<const std::vector<std::size_t>*> lists;  // each once, however often its key is repeated
  for (const Word& key : named.keys) lists.insert(&havingKey_[key.text]);
  if (!named.parents.empty()) lists.insert(&havingKey_[parentsOf(named)]);
  std::vector<const std::vector<std::size_t>*> rarestFirst(lists.begin(), lists.end());
  std::sort(rarestFirst.begin(), rarestFirst.end(), [](auto a, auto b) { return a->size() < b->size(); });
  std::vector<std::size_t> matching = *rarestFirst.front(), some;
  rarestFirst.push_back(&live_);
  for (const std::vector<std::size_t>* having : rarestFirst) {
    some.clear();
    if (matching.empty()) return 0;
    std::set_intersection(matching.begin(), matching.end(), having->begin(), having->end(),
                          std::back_inserter(some));
    std::swap(matching, some);
  }
  some.clear();
  std::set_difference(live_.begin(), live_.end(), matching.begin(), matching.end(), std::back_inserter(some));
  std::swap(live_, some);
  return matching.size();
}

Graph NodeList::finish() {
  if (std::any_of(live_.begin(), live_.end(), [&](std::size_t i) { return isEdit(nodes_[i]); })) mergeEdits();
  Graph graph;
  graph.reserve(live_.size());
  for (const std::size_t i : live_) graph.push_back(std::move(nodes_[i]));
  return graph;
}

void NodeList::mergeEdits() {
  Index firstOf;
  std::unordered_map<std::size_t, Merger> mergers;
  std::vector<std::size_t> kept;
  for (const std::size_t i : live_) {
    Node& node = nodes_[i];
    if (isEdit(node)) {
      node.keys.erase(node.keys.begin());
      const auto partner = partnerOf(node, firstOf);
      if (!partner) failWithoutPartner(node, kept);
      mergers[*partner].merge(nodes_[*partner], std::move(node));
    } else {
      addTexts(i, firstOf);
      kept.push_back(i);
    }
  }
  for (const auto& [edited, merger] : mergers) dropNameless(nodes_[edited]);
  live_ = std::move(kept);
}

void NodeList::addTexts(std::size_t i, Index& firstOf) const {
  firstOf.emplace(joinedKeys(nodes_[i]), i);
  if (!nodes_[i].parents.empty()) firstOf.emplace(textOf(nodes_[i]), i);
  if (const std::string name = nameOfJoint(nodes_[i]); !name.empty()) firstOf.emplace("joint " + name, i);
}

// Only statements with a name are recognised without their parents, so that parents can be replaced.
std::optional<std::size_t> NodeList::partnerOf(const Node& edit, const Index& firstOf) const {
  auto found = firstOf.find(textOf(edit));
  if (found == firstOf.end() && edit.keys.size() > 1) found = firstOf.find(joinedKeys(edit));
  return found == firstOf.end() ? std::nullopt : std::optional(found->second);
}

void NodeList::failWithoutPartner(const Node& edit, const std::vector<std::size_t>& earlier) const {
  const bool hasParents = !edit.parents.empty();
  std::vector<std::string> known;
  for (const std::size_t i : earlier) {
    const std::string joint = hasParents ? "" : nameOfJoint(nodes_[i]);
    known.push_back(hasParents      ? textOf(nodes_[i])
                    : joint.empty() ? joinedKeys(nodes_[i])
                                    : "joint " + joint);
  }
  throw Error({.what = "nothing to edit",
               .where = edit.where,
               .found = fmt::format("'{}'", textOf(edit)),
               .wanted = fmt::format("the words{} of an earlier statement", hasParents ? " and parents" : ""),
               .nearest = nearestOfMany(textOf(edit), std::move(known))});
}

}  // namespace rex::ors
